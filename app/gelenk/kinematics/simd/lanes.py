"""A numba type that holds eight numbers side by side in one vector register.

A compiled function written for one number (`frame` products, polynomials, factorisations) works on `Lanes` unchanged:
the operators are the machine's vector instructions. So one source serves one configuration and eight, for any number
of joints, and does not rely on the compiler to vectorise loops. On processors with shorter registers LLVM splits the
operations. `Lanes` exist only inside compiled functions; a comparison gives a `Mask`.
"""

import operator
from collections.abc import Callable
from typing import Any, TypeAlias

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import impl_ret_borrowed, lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, models, register_model
from numba.np.arrayobj import populate_array

Lanes: TypeAlias = Any
"""Eight doubles, for annotations only: the compiler uses `LanesType`."""

LANES = 8
"""Number of doubles per register, as in AVX-512."""

_DOUBLES = ir.VectorType(ir.DoubleType(), LANES)
_BOOLS = ir.VectorType(ir.IntType(1), LANES)


class LanesType(types.Type):
    """Numba type of eight doubles."""

    def __init__(self) -> None:
        super().__init__(name="Lanes")


class MaskType(types.Type):
    """Numba type of eight truth values."""

    def __init__(self) -> None:
        super().__init__(name="Mask")


lanes_type, mask_type = LanesType(), MaskType()


@register_model(LanesType)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, type_: LanesType) -> None:
        super().__init__(manager, type_, _DOUBLES)


@register_model(MaskType)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager: Any, type_: MaskType) -> None:
        super().__init__(manager, type_, _BOOLS)


def _compiled_call(emitter: Callable[..., Any]) -> Any:
    """Turn an emitter of LLVM instructions into a function for compiled code; Any to a type checker."""
    return intrinsic(emitter)


def _splat(builder: ir.IRBuilder, scalar: ir.Value) -> ir.Value:
    vector = builder.insert_element(ir.Constant(_DOUBLES, ir.Undefined), scalar, ir.Constant(ir.IntType(32), 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(vector, ir.Constant(_DOUBLES, ir.Undefined), zeros)


def _as_lanes(context: Any, builder: ir.IRBuilder, type_: Any, value: ir.Value) -> ir.Value:
    """Lanes and masks as they are, a number in every lane."""
    if isinstance(type_, LanesType | MaskType):
        return value
    return _splat(builder, context.cast(builder, value, type_, types.float64))


def _operator(function: Callable[..., Any], result: Any, emit: Callable[..., Any], *operands: tuple[Any, ...]) -> None:
    class Template(AbstractTemplate):
        key = function

        def generic(self, args: Any, kws: Any) -> Any:
            fits = any(len(args) == len(kinds) and all(map(isinstance, args, kinds)) for kinds in operands)
            return signature(result, *args) if fits and not kws else None

    infer_global(function)(Template)

    def lower(context: Any, builder: ir.IRBuilder, sig: Any, args: Any) -> Any:
        pairs = zip(sig.args, args, strict=True)
        return emit(builder, *(_as_lanes(context, builder, type_, value) for type_, value in pairs))

    for kinds in operands:
        lower_builtin(function, *kinds)(lower)


def _comparison(relation: str) -> Callable[..., Any]:
    return lambda builder, a, b: builder.fcmp_ordered(relation, a, b)


_PAIRS = (
    (LanesType, LanesType),
    (LanesType, types.Float),
    (types.Float, LanesType),
    (LanesType, types.Integer),
    (types.Integer, LanesType),
)
_operator(operator.add, lanes_type, ir.IRBuilder.fadd, *_PAIRS)
_operator(operator.sub, lanes_type, ir.IRBuilder.fsub, *_PAIRS)
_operator(operator.mul, lanes_type, ir.IRBuilder.fmul, *_PAIRS)
_operator(operator.truediv, lanes_type, ir.IRBuilder.fdiv, *_PAIRS)
_operator(operator.neg, lanes_type, ir.IRBuilder.fneg, (LanesType,))
_operator(operator.lt, mask_type, _comparison("<"), *_PAIRS)
_operator(operator.le, mask_type, _comparison("<="), *_PAIRS)
_operator(operator.gt, mask_type, _comparison(">"), *_PAIRS)
_operator(operator.ge, mask_type, _comparison(">="), *_PAIRS)
_operator(operator.and_, mask_type, ir.IRBuilder.and_, (MaskType, MaskType))
_operator(operator.or_, mask_type, ir.IRBuilder.or_, (MaskType, MaskType))


def _call(builder: ir.IRBuilder, name: str, *values: ir.Value) -> ir.Value:
    function_type = ir.FunctionType(_DOUBLES, [_DOUBLES] * len(values))
    module = builder.module
    full = f"llvm.{name}.v{LANES}f64"
    function = module.globals.get(full) or ir.Function(module, function_type, full)
    return builder.call(function, values)


def _elementwise(name: str) -> Any:
    @_compiled_call
    def function(_typing: Any, x: Any) -> Any:
        if x != lanes_type:
            return None
        return lanes_type(lanes_type), lambda _c, builder, _s, args: _call(builder, name, args[0])

    return function


sqrt_lanes, rint_lanes, floor_lanes, abs_lanes = (_elementwise(name) for name in ("sqrt", "rint", "floor", "fabs"))


def _extreme(relation: str) -> Any:
    @_compiled_call
    def function(_typing: Any, a: Any, b: Any) -> Any:
        def emit(context: Any, builder: ir.IRBuilder, sig: Any, args: Any) -> Any:
            x, y = (_as_lanes(context, builder, type_, value) for type_, value in zip(sig.args, args, strict=True))
            return builder.select(builder.fcmp_ordered(relation, x, y), x, y)

        return lanes_type(a, b), emit

    return function


min_lanes, max_lanes = _extreme("<"), _extreme(">")
"""Minimum and maximum of two, lane by lane; the second value where one is NaN."""


@_compiled_call
def lanes(_typing: Any, x: Any) -> Any:
    """Return lanes that all hold the same number."""
    return lanes_type(types.float64), lambda _c, builder, _s, args: _splat(builder, args[0])


def _address(context: Any, builder: ir.IRBuilder, array_type: Any, array: Any, index: ir.Value) -> ir.Value:
    data = context.make_array(array_type)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), _DOUBLES.as_pointer())


def _is_flat(array: Any) -> bool:
    return isinstance(array, types.Array) and array.ndim == 1 and array.layout == "C" and array.dtype == types.float64


@_compiled_call
def load(_typing: Any, array: Any, row: Any) -> Any:
    """Load lanes from row `row` of a flat work array, LANES numbers per row."""
    if not _is_flat(array):
        return None

    def emit(context: Any, builder: ir.IRBuilder, _sig: Any, args: Any) -> Any:
        start = builder.mul(args[1], ir.Constant(ir.IntType(64), LANES))
        return builder.load(_address(context, builder, array, args[0], start), align=8)

    return lanes_type(array, types.int64), emit


@_compiled_call
def store(_typing: Any, array: Any, row: Any, value: Any) -> Any:
    """Store lanes in row `row` of a flat work array."""
    if not _is_flat(array):
        return None

    def emit(context: Any, builder: ir.IRBuilder, _sig: Any, args: Any) -> Any:
        start = builder.mul(args[1], ir.Constant(ir.IntType(64), LANES))
        builder.store(args[2], _address(context, builder, array, args[0], start), align=8)
        return context.get_dummy_value()

    return types.none(array, types.int64, lanes_type), emit


@_compiled_call
def where(_typing: Any, mask: Any, a: Any, b: Any) -> Any:
    """Select `a` in the lanes where the mask is true, else `b`."""

    def emit(context: Any, builder: ir.IRBuilder, sig: Any, args: Any) -> Any:
        a_value, b_value = (_as_lanes(context, builder, sig.args[i], args[i]) for i in (1, 2))
        return builder.select(args[0], a_value, b_value)

    return lanes_type(mask_type, a, b), emit


@_compiled_call
def bits(_typing: Any, mask: Any) -> Any:
    """Return a mask as an integer, with lane 0 as the lowest bit."""

    def emit(_context: Any, builder: ir.IRBuilder, _sig: Any, args: Any) -> Any:
        return builder.zext(builder.bitcast(args[0], ir.IntType(LANES)), ir.IntType(64))

    return types.int64(mask_type), emit


@_compiled_call
def part(_typing: Any, array: Any, first: Any, shape: Any) -> Any:
    """Return a view of a flat array from entry `first` on, unchecked.

    Where one is made for each call, `reshape`, which is a call itself, and slices, which look for bounds, cost a sixth
    of a whole solution.
    """
    if not isinstance(array, types.Array) or array.ndim != 1 or array.layout != "C":
        return None

    def emit(context: Any, builder: ir.IRBuilder, sig: Any, args: Any) -> Any:
        flat = context.make_array(sig.args[0])(context, builder, args[0])
        view = context.make_array(sig.return_type)(context, builder)
        lengths, strides = cgutils.unpack_tuple(builder, args[2]), [flat.itemsize]
        for length in reversed(lengths[1:]):
            strides.insert(0, builder.mul(length, strides[0]))
        data = builder.gep(flat.data, [args[1]])
        populate_array(view, data, lengths, strides, flat.itemsize, flat.meminfo, flat.parent)
        return impl_ret_borrowed(context, builder, sig.return_type, view._getvalue())

    return array.copy(ndim=len(shape))(array, types.int64, types.UniTuple(types.int64, len(shape))), emit
