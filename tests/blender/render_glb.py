# SPDX-License-Identifier: MIT
# A picture by Cycles (scripts/render_comparison.sh), run inside Blender:
#   blender -b --factory-startup --python render_glb.py -- MAPS model.glb sky.exr SIZE out.png
# Tone mapped here by Khronos PBR Neutral, because Blender 3.4 does not have it.
import math
import os
import sys

import bpy
import numpy

if "bool" not in vars(numpy):  # see import_glb.py
    numpy.bool = bool
maps, model, sky, size, out = sys.argv[-5:]
scene = bpy.context.scene
for o in list(scene.objects):
    bpy.data.objects.remove(o)
bpy.ops.import_scene.gltf(filepath=model)
thing = next(o for o in scene.objects if o.type == "MESH")
radius = max(v.co.length for v in thing.data.vertices)
thing.rotation_mode = "XYZ"
thing.rotation_euler = (0, 0, 0.4)
thing.scale = (1 / radius,) * 3

material = bpy.data.materials.new("maps")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
surface = nodes["Principled BSDF"]
surface.inputs["Specular"].default_value = 0.5  # F0 0.04


def picture(ending, space):
    node = nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(os.path.join(maps, next(f for f in os.listdir(maps) if f.endswith(ending))))
    node.image.colorspace_settings.name = space
    return node


links.new(picture("_Color.png", "sRGB").outputs["Color"], surface.inputs["Base Color"])
split = nodes.new("ShaderNodeSeparateColor")
links.new(picture("_ORM.png", "Non-Color").outputs["Color"], split.inputs["Color"])
links.new(split.outputs["Green"], surface.inputs["Roughness"])
links.new(split.outputs["Blue"], surface.inputs["Metallic"])
bent = nodes.new("ShaderNodeNormalMap")
links.new(picture("_NormalGL.png", "Non-Color").outputs["Color"], bent.inputs["Color"])
links.new(bent.outputs["Normal"], surface.inputs["Normal"])
thing.data.materials.clear()
thing.data.materials.append(material)

world = scene.world or bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
around = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
around.image = bpy.data.images.load(sky)
world.node_tree.links.new(around.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])

camera = bpy.data.cameras.new("camera")
camera.angle = math.radians(26)
eye = bpy.data.objects.new("camera", camera)
eye.location = (0, -5.1, 1.3)
eye.rotation_euler = (math.radians(90) - math.atan2(1.3, 5.1), 0, 0)
scene.collection.objects.link(eye)
scene.camera = eye

scene.render.engine = "CYCLES"
scene.cycles.samples = 512
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 3
scene.render.film_transparent = True
scene.render.resolution_x = scene.render.resolution_y = int(size)
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = out + ".linear.exr"
bpy.ops.render.render(write_still=True)

light = bpy.data.images.load(out + ".linear.exr")
pixels = numpy.array(light.pixels[:], dtype=numpy.float64).reshape(int(size), int(size), 4)
os.remove(out + ".linear.exr")
c = pixels[..., :3] + 0.1 * (1 - pixels[..., 3:])
least = c.min(-1, keepdims=True)
c = c - numpy.where(least < 0.08, least - 6.25 * least * least, 0.04)
peak = numpy.maximum(c.max(-1, keepdims=True), 1e-9)
rolled = 1 - 0.24**2 / (peak + 0.24 - 0.76)
white = 1 - 1 / (0.15 * (peak - rolled) + 1)
c = numpy.where(peak < 0.76, c, (c * rolled / peak) * (1 - white) + rolled * white)
c = numpy.where(c <= 0.0031308, 12.92 * c, 1.055 * numpy.clip(c, 1e-9, 1) ** (1 / 2.4) - 0.055)
result = bpy.data.images.new("result", int(size), int(size), alpha=False)
result.colorspace_settings.name = "Non-Color"
result.pixels = numpy.concatenate([c, numpy.ones_like(c[..., :1])], -1).ravel().tolist()
result.filepath_raw = out
result.file_format = "PNG"
result.save()
