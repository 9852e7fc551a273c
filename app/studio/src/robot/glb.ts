/** Reads the small meshes of the service: GLB whose points and normals are whole numbers, each part in one colour. */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  LinearSRGBColorSpace,
  type Material,
  Mesh,
  MeshPhongMaterial,
} from "three";

export const GLB = "model/gltf-binary";

type Triple = [number, number, number];

interface Document {
  nodes: [{ translation: Triple; scale: Triple }];
  meshes: [{ primitives: { attributes: { POSITION: number; NORMAL: number }; indices: number; material?: number }[] }];
  materials?: { pbrMetallicRoughness: { baseColorFactor: Triple }; emissiveFactor: Triple }[];
  accessors: { bufferView: number; componentType: number; count: number }[];
  bufferViews: { byteOffset: number; byteStride?: number }[];
}

const HEADER = 12;
const CHUNK = 8;
const ARRAYS = { 5120: Int8Array, 5123: Uint16Array, 5125: Uint32Array } as const;

/** @param material of parts that have no colour of their own. */
export function readGlb(content: ArrayBuffer, material: Material): Group {
  const length = new DataView(content).getUint32(HEADER, true);
  const text = new TextDecoder().decode(new Uint8Array(content, HEADER + CHUNK, length));
  const document = JSON.parse(text) as Document;
  const start = HEADER + CHUNK + length + CHUNK;
  const { translation, scale } = document.nodes[0];
  const group = new Group();
  const colours = (document.materials ?? []).map(coloured);
  for (const { attributes, indices, material: own } of document.meshes[0].primitives) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", triples(attributes.POSITION, scale, translation));
    geometry.setAttribute("normal", triples(attributes.NORMAL, [1 / 127, 1 / 127, 1 / 127], [0, 0, 0]));
    geometry.setIndex(new BufferAttribute(numbers(indices, 1).array.slice(), 1));
    group.add(new Mesh(geometry, own === undefined ? material : colours[own]));
  }
  return group;

  function numbers(accessor: number, width: number) {
    const { bufferView, componentType, count } = document.accessors[accessor]!;
    const { byteOffset, byteStride } = document.bufferViews[bufferView]!;
    const Kind = ARRAYS[componentType as keyof typeof ARRAYS];
    const stride = byteStride ? byteStride / Kind.BYTES_PER_ELEMENT : width;
    return { array: new Kind(content, start + byteOffset, count * stride), stride, count };
  }

  function triples(accessor: number, factor: Triple, offset: Triple): BufferAttribute {
    const { array, stride, count } = numbers(accessor, 3);
    const found = new Float32Array(3 * count);
    for (let i = 0; i < count; i += 1)
      for (let axis = 0; axis < 3; axis += 1)
        found[3 * i + axis] = array[stride * i + axis]! * factor[axis]! + offset[axis]!;
    return new BufferAttribute(found, 3);
  }
}

function coloured({ pbrMetallicRoughness, emissiveFactor }: NonNullable<Document["materials"]>[number]): Material {
  const [colour, emitted] = [pbrMetallicRoughness.baseColorFactor, emissiveFactor].map(([red, green, blue]) =>
    new Color().setRGB(red, green, blue, LinearSRGBColorSpace),
  );
  return new MeshPhongMaterial({ color: colour!, emissive: emitted!, specular: 0x222222, shininess: 18 });
}
