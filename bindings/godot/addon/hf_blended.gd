# A MeshInstance3D of Godot 4 that the GPU poses: a shader blends the transforms of a frame, and no vertex is computed here.
#
#   var blended = preload("res://addons/hf/hf_blended.gd").new()
#   blended.mesh = some_mesh
#   add_child(blended)
#   blended.bind(surface)                                     # an HfSurface of that mesh, with handles
#   surface.set_transform(handle, null, Vector3(0, 0.1, 0))
#   blended.update()                                          # in every frame
#
# For a look of your own give bind() a shader that includes hf_blend.gdshaderinc. Poses with refine, rigid pieces or higher
# layers are for hf_deformer.gd.
extends MeshInstance3D

const SHADER = """shader_type spatial;
#include "res://addons/hf/hf_blend.gdshaderinc"
void fragment() { ALBEDO = vec3(0.62, 0.42, 0.3); ROUGHNESS = 0.8; }
"""
const WIDTH = 960 # of textures; a multiple of 3

var surface = null
var revision = -1
var given = null # the mesh that was set, at rest
var made = null # the mesh of rows that is drawn in its place
var rest = []
var transforms = ImageTexture.new()

# Uploads the rows. Returns false with a warning that says why not. Another surface may be bound later: its revisions count anew.
func bind(with, shader = null):
	surface = with
	revision = -1
	if mesh != made:
		given = mesh
	rest = given.surface_get_arrays(0)
	if shader == null:
		shader = Shader.new()
		shader.code = SHADER # before a material has it
	var material = ShaderMaterial.new()
	material.shader = shader
	material_override = material
	return update()

# Solves the pose and uploads its transforms.
func update(iterations = 0):
	var info = surface.pose_blend_info() if surface.pose_solve(iterations) != null else null
	if info == null:
		push_warning("hf: " + surface.get_error().get("message", "not posed"))
		return false
	if info.revision != revision:
		upload(info)
	var image = image_of(surface.blend_transforms(), 4)
	if transforms.get_size() == Vector2(image.get_size()):
		transforms.update(image)
	else:
		transforms.set_image(image)
	material_override.set_shader_parameter("hf_offset_share", info.offset_share)
	var box = surface.blend_box() # else the engine culls by the mesh at rest
	custom_aabb = AABB(box[0], box[1] - box[0])
	return true

func upload(info):
	revision = info.revision
	var arrays = rest.duplicate()
	arrays[Mesh.ARRAY_VERTEX] = surface.blend_positions()
	arrays[Mesh.ARRAY_NORMAL] = surface.blend_normals()
	arrays[Mesh.ARRAY_BONES] = null
	arrays[Mesh.ARRAY_WEIGHTS] = null
	arrays[Mesh.ARRAY_CUSTOM0] = PackedFloat32Array(Array(surface.blend_rows()))
	var offsets = PackedFloat32Array()
	for offset in surface.blend_offsets():
		offsets.append_array([offset.x, offset.y, offset.z])
	arrays[Mesh.ARRAY_CUSTOM1] = offsets
	var formats = Mesh.ARRAY_CUSTOM_RG_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT | Mesh.ARRAY_CUSTOM_RGB_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM1_SHIFT
	made = ArrayMesh.new()
	made.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], {}, formats)
	mesh = made
	var parameters = {
		"hf_clusters": ImageTexture.create_from_image(image_of(PackedFloat32Array(Array(surface.blend_clusters())), 1)),
		"hf_entries": ImageTexture.create_from_image(image_of(surface.blend_entries(), 4)),
		"hf_transforms": transforms,
		"hf_centre": surface.blend_centre()[0],
	}
	for name in parameters:
		material_override.set_shader_parameter(name, parameters[name])

# A list of floats as a picture, row by row.
func image_of(list, channels):
	var data = PackedFloat32Array(list)
	var height = (data.size() + WIDTH * channels - 1) / (WIDTH * channels)
	data.resize(WIDTH * height * channels)
	return Image.create_from_data(WIDTH, height, false, Image.FORMAT_RF if channels == 1 else Image.FORMAT_RGBAF, data.to_byte_array())
