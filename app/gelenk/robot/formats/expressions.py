"""Evaluates xacro's expressions: a small part of Python, read by `ast`, without builtins and within bounds.

Numbers, texts, lists and dictionaries; arithmetic, comparisons, conditions, comprehensions; the functions of a table.
Nothing of Python's own objects can be reached: an attribute is a key of a dictionary, a name of a namespace, or one of
a few methods of texts and dictionaries. Every step counts, and no value grows beyond a bound.
"""

import ast
import operator
import warnings
from collections.abc import Callable, Iterable, Iterator
from functools import partial

from gelenk.errors import quoted
from gelenk.robot.formats.functions import METHODS
from gelenk.robot.formats.sources import Fault
from gelenk.robot.formats.values import (
    MAX_BITS,
    MAX_ITEMS,
    Function,
    Namespace,
    Steps,
    Value,
    checked,
    gathered,
    sequence,
)

_BINARY: dict[type[ast.operator], Callable[[Value, Value], Value]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_UNARY: dict[type[ast.unaryop], Callable[[Value], Value]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Value, Value], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda one, many: one in many,
    ast.NotIn: lambda one, many: one not in many,
}


def evaluate(text: str, names: Namespace, steps: Steps) -> Value:
    """Return the value of an expression; raises Fault with the reason."""
    steps.take(len(text) // 4)  # parsing makes a node of every few characters
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python's opinions about the style of an expression
            tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        raise Fault(f"the expression {quoted(text)} cannot be read: {getattr(error, 'msg', 'too complex')}") from error
    try:
        return _Evaluation(names, steps).of(tree.body)
    except Fault as fault:
        raise Fault(f"{fault}, in the expression {quoted(text)}") from None
    except ZeroDivisionError:
        raise Fault(f"division by zero in the expression {quoted(text)}") from None
    except (ArithmeticError, ValueError, TypeError, LookupError, AttributeError) as error:
        raise Fault(f"{' '.join(str(error).split())}, in the expression {quoted(text)}") from error


class _Evaluation:
    def __init__(self, names: Namespace, steps: Steps) -> None:
        self._names, self._steps = names, steps
        self._local: dict[str, Value] = {}

    def of(self, node: ast.expr) -> Value:
        self._steps.take()
        method = getattr(self, f"_{type(node).__name__.lower()}", None)
        if method is None:
            raise Fault(f"{type(node).__name__} is not part of what is evaluated here")
        return method(node)

    def _checked(self, value: Value) -> Value:
        return checked(value, self._steps)

    def _gathered(self, parts: Iterable[Value]) -> list[Value]:
        return gathered(parts, self._steps)

    def _constant(self, node: ast.Constant) -> Value:
        if isinstance(node.value, bool | int | float | str | None):
            return self._checked(node.value)
        raise Fault(f"a value of type {type(node.value).__name__}")

    def _name(self, node: ast.Name) -> Value:
        return self._local[node.id] if node.id in self._local else self._names.value(node.id)

    def _binop(self, node: ast.BinOp) -> Value:
        function = _BINARY.get(type(node.op))
        if function is None:
            raise Fault(f"the operator {type(node.op).__name__}")
        left, right = self.of(node.left), self.of(node.right)
        if isinstance(node.op, ast.Mult):
            for many, times in ((left, right), (right, left)):
                if isinstance(many, str | list | tuple) and isinstance(times, int) and len(many) * times > MAX_ITEMS:
                    raise Fault(f"a repetition to more than {MAX_ITEMS} items")
        if isinstance(node.op, ast.Mod) and isinstance(left, str):
            raise Fault("formatting by %")
        is_whole = isinstance(left, int) and isinstance(right, int)
        if isinstance(node.op, ast.Pow) and is_whole and abs(right) * max(left.bit_length(), 1) > MAX_BITS:
            raise Fault(f"a power of more than {MAX_BITS} bits")
        return self._checked(function(left, right))

    def _unaryop(self, node: ast.UnaryOp) -> Value:
        function = _UNARY.get(type(node.op))
        if function is None:
            raise Fault(f"the operator {type(node.op).__name__}")
        return function(self.of(node.operand))

    def _boolop(self, node: ast.BoolOp) -> Value:
        is_and, value = isinstance(node.op, ast.And), None
        for part in node.values:
            value = self.of(part)
            if bool(value) is not is_and:
                break
        return value

    def _compare(self, node: ast.Compare) -> bool:
        left = self.of(node.left)
        for sign, part in zip(node.ops, node.comparators, strict=True):
            right = self.of(part)
            self._checked(right)  # comparing may look at all of it
            if not _COMPARE[type(sign)](left, right):
                return False
            left = right
        return True

    def _ifexp(self, node: ast.IfExp) -> Value:
        return self.of(node.body if self.of(node.test) else node.orelse)

    def _list(self, node: ast.List) -> Value:
        return self._gathered(map(self.of, node.elts))

    def _tuple(self, node: ast.Tuple) -> Value:
        return tuple(self._gathered(map(self.of, node.elts)))

    def _dict(self, node: ast.Dict) -> Value:
        if None in node.keys:
            raise Fault("a dictionary with **")
        keys = self._gathered(self.of(key) for key in node.keys if key is not None)
        return self._checked(dict(zip(keys, self._gathered(map(self.of, node.values)), strict=True)))

    def _subscript(self, node: ast.Subscript) -> Value:
        whole = self.of(node.value)
        if not isinstance(whole, str | list | tuple | dict):
            raise Fault(f"there is nothing by [ ] in a value of type {type(whole).__name__}")
        if isinstance(node.slice, ast.Slice):
            parts = (node.slice.lower, node.slice.upper, node.slice.step)
            return self._checked(whole[slice(*(None if part is None else self.of(part) for part in parts))])
        key = self.of(node.slice)
        if isinstance(whole, dict) and key not in whole:
            raise Fault(f"the dictionary has no key {quoted(str(key))}")
        return whole[key]

    def _attribute(self, node: ast.Attribute) -> Value:
        if node.attr.startswith("_"):
            raise Fault(f"the name {quoted(node.attr)}, which begins with _")
        whole = self.of(node.value)
        if isinstance(whole, dict) and node.attr in whole:
            return whole[node.attr]
        methods = METHODS.get(type(whole), {})
        if node.attr in methods:
            return Function(node.attr, partial(methods[node.attr], whole), 1 + len(whole))
        if isinstance(whole, dict):
            raise Fault(f"the dictionary has no key {quoted(node.attr)}")
        if hasattr(whole, "value") and not isinstance(whole, Function):
            return whole.value(node.attr)
        raise Fault(f"a value of type {type(whole).__name__} has no {quoted(node.attr)}")

    def _call(self, node: ast.Call) -> Value:
        function = self.of(node.func)
        if not isinstance(function, Function):
            raise Fault("only a function can be called")
        if any(isinstance(part, ast.Starred) for part in node.args) or any(word.arg is None for word in node.keywords):
            raise Fault("a call with * or **")
        given = self._gathered(map(self.of, node.args))
        words = [str(word.arg) for word in node.keywords]
        named = dict(zip(words, self._gathered(self.of(word.value) for word in node.keywords), strict=True))
        every = [*given, *named.values()]
        length = sum(len(value) for value in every if isinstance(value, list | tuple | dict | str))
        called = max((value.cost for value in every if isinstance(value, Function)), default=1)  # once for each item
        self._steps.take(function.cost + length * called)
        return self._checked(function.call(*given, **named))

    def _listcomp(self, node: ast.ListComp) -> Value:
        if len(node.generators) != 1:
            raise Fault("a comprehension with several loops")
        (loop,) = node.generators
        before = dict(self._local)
        found = self._gathered(self._items(node, loop))
        self._local = before
        return found

    _generatorexp = _listcomp

    def _items(self, node: ast.ListComp, loop: ast.comprehension) -> Iterator[Value]:
        for item in sequence(self.of(loop.iter)):
            self._bind(loop.target, item)
            if all(self.of(condition) for condition in loop.ifs):
                yield self.of(node.elt)

    def _bind(self, target: ast.expr, item: Value) -> None:
        if isinstance(target, ast.Name):
            self._local[target.id] = item
        elif isinstance(target, ast.Tuple) and len(target.elts) == len(parts := sequence(item)):
            for one, part in zip(target.elts, parts, strict=True):
                self._bind(one, part)
        else:
            raise Fault("the loop's variable")
