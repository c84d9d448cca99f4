"""Writes a scene as one glTF file."""
import base64
import json
import math
import pathlib
import tempfile

import mitsuba as mi


def png(texels):
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        mi.Bitmap(texels).write(file.name)
        return pathlib.Path(file.name).read_bytes()


def write_gltf(path, parts, lights):
    """All in one file. Light in the file: (KHR light, position), shining down."""
    data, views, accessors, meshes, materials, images, nodes = b"", [], [], [], [], [], []

    def accessor(array, kind, component):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data += array.tobytes()
        entry = {"bufferView": len(views) - 1, "componentType": component, "type": kind,
                 "count": len(array)}
        if kind == "VEC3":
            entry.update(min=array.min(axis=0).tolist(), max=array.max(axis=0).tolist())
        accessors.append(entry)
        return len(accessors) - 1

    for (positions, triangles, coordinates), (material, *_) in parts:
        material = dict(material, doubleSided=True)
        texels = material.pop("texels", None)
        if texels is not None:
            images.append({"uri": "data:image/png;base64," + base64.b64encode(png(texels)).decode()})
        meshes.append({"primitives": [{
            "attributes": {"POSITION": accessor(positions, "VEC3", 5126),
                           "TEXCOORD_0": accessor(coordinates, "VEC2", 5126)},
            "indices": accessor(triangles.reshape(-1), "SCALAR", 5125),
            "material": len(materials)}]})
        nodes.append({"mesh": len(meshes) - 1})
        materials.append(material)
    turned = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]  # -Z becomes -Y
    for i, (_, position) in enumerate(lights):
        nodes.append({"translation": position, "rotation": turned,
                      "extensions": {"KHR_lights_punctual": {"light": i}}})
    content = {"asset": {"version": "2.0"}, "scene": 0,
               "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
               "materials": materials, "accessors": accessors, "bufferViews": views,
               "buffers": [{"byteLength": len(data), "uri":
                            "data:application/octet-stream;base64,"
                            + base64.b64encode(data).decode()}]}
    if images:
        content.update(images=images, textures=[{"source": 0}])
    if lights:
        content["extensions"] = {"KHR_lights_punctual": {"lights": [light for light, _ in lights]}}
    path.write_text(json.dumps(content))
