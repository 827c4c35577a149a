# SPDX-License-Identifier: MIT
# Run inside Blender:  blender -b --factory-startup --python import_glb.py -- aged.glb STATES
# Imports the file as File > Import > glTF does and says what is not as an artist would want it.
# Prints "blender: fine" and nothing else of its own if all is well.
import sys

import bpy
import numpy

# Debian 12 pairs Blender 3.4's importer, which says numpy.bool, with a numpy that no longer has it:
# there no glTF file with normals can be imported with the default settings. That is not ours to
# test, and a user escapes it with Shading: Smooth Shading in the import dialog.
if "bool" not in vars(numpy):
    numpy.bool = bool

path, states = sys.argv[-2], int(sys.argv[-1])
wrong = []


def expect(fine, sentence):
    if not fine:
        wrong.append(sentence)


def source(socket):
    """The node and the socket that feed `socket`; two Nones if nothing does."""
    if not socket.is_linked:
        return None, None
    return socket.links[0].from_node, socket.links[0].from_socket


def check_picture(node, what, suffix, space):
    if node is None or node.bl_idname != "ShaderNodeTexImage" or node.image is None:
        wrong.append(f"{what}: no picture is linked")
        return
    image = node.image
    expect(suffix in image.name, f"{what}: the picture is {image.name}, not {suffix}")
    # In this order: asking for the size is what loads the picture.
    expect(min(image.size) > 0 and image.has_data, f"{what}: {image.name} holds no pixels")
    expect(image.colorspace_settings.name == space,
           f"{what}: {image.name} is {image.colorspace_settings.name}, not {space}")
    expect(node.extension == "EXTEND", f"{what}: the picture repeats, but it is not made to tile")


def check_material(material):
    name = material.name
    if not material.use_nodes:
        wrong.append(f"{name}: has no nodes")
        return
    shaders = [n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled"]
    outputs = [n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial"]
    if len(shaders) != 1 or len(outputs) != 1:
        wrong.append(f"{name}: {len(shaders)} Principled BSDFs and {len(outputs)} outputs")
        return
    shader = shaders[0]
    expect(source(outputs[0].inputs["Surface"])[0] == shader,
           f"{name}: the Principled BSDF is not the surface")
    expect(not material.use_backface_culling, f"{name}: the back is culled")

    check_picture(source(shader.inputs["Base Color"])[0], f"{name}: base color", "_Color", "sRGB")
    for channel, wanted in (("Metallic", "Blue"), ("Roughness", "Green")):
        split, out = source(shader.inputs[channel])
        if split is None or split.bl_idname != "ShaderNodeSeparateColor":
            wrong.append(f"{name}: {channel} is not taken from a packed picture")
            continue
        expect(out.name == wanted, f"{name}: {channel} is read from {out.name}, not {wanted}")
        check_picture(source(split.inputs["Color"])[0], f"{name}: {channel}", "_ORM", "Non-Color")
    normal, _ = source(shader.inputs["Normal"])
    if normal is None or normal.bl_idname != "ShaderNodeNormalMap":
        wrong.append(f"{name}: no normal map is linked")
        return
    expect(normal.space == "TANGENT", f"{name}: the normals are in {normal.space} space")
    expect(abs(normal.inputs["Strength"].default_value - 1) < 1e-6,
           f"{name}: the normal map is scaled by {normal.inputs['Strength'].default_value}")
    check_picture(source(normal.inputs["Color"])[0], f"{name}: normal", "_NormalGL", "Non-Color")


def check_quad(mesh):
    expect(len(mesh.uv_layers) == 1, f"{mesh.name}: {len(mesh.uv_layers)} UV layers")
    heights = [v.co.z for v in mesh.vertices]
    rights = [v.co.x for v in mesh.vertices]
    for loop, uv in zip(mesh.loops, mesh.uv_layers[0].data):
        at = mesh.vertices[loop.vertex_index].co
        # Upright and not mirrored, seen from the front (-Y).
        expect((uv.uv.y > 0.5) == (at.z > sum(heights) / 4), f"{mesh.name}: upside down")
        expect((uv.uv.x > 0.5) == (at.x > sum(rights) / 4), f"{mesh.name}: mirrored")
    expect(all(p.normal.y < -0.99 for p in mesh.polygons), f"{mesh.name}: does not face the front")


bpy.ops.wm.read_factory_settings(use_empty=True)
try:
    result = bpy.ops.import_scene.gltf(filepath=path)
    expect(result == {"FINISHED"}, f"the import ended with {result}")
except RuntimeError as error:
    wrong.append(f"the import failed: {error}")
materials = [m for m in bpy.data.materials if m.name != "Dots Stroke"]
expect(len(materials) == states, f"{len(materials)} materials instead of {states}")
for m in materials:
    check_material(m)
meshes = list(bpy.data.meshes)
expect(len(meshes) == 1, f"{len(meshes)} meshes instead of one quad")
for m in meshes:
    check_quad(m)
for sentence in wrong:
    print(f"blender: WRONG: {sentence}")
if not wrong:
    print("blender: fine")
sys.exit(1 if wrong else 0)
