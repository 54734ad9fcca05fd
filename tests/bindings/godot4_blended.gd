# hf_blended.gd of the add-on draws what hf_deform writes: godot --path PROJECT -s test.gd, under Xvfb. The pictures stand
# beside $HF_PICTURE.
extends SceneTree

const Deformer = preload("res://addons/hf/hf_deformer.gd")
const Blended = preload("res://addons/hf/hf_blended.gd")
const Host = preload("res://host.gd")

# The share of pixels that differ.
func apart(one, other):
	var different = 0
	for y in one.get_height():
		for x in one.get_width():
			var a = one.get_pixel(x, y)
			var b = other.get_pixel(x, y)
			different += 1 if abs(a.r - b.r) + abs(a.g - b.g) + abs(a.b - b.b) > 0.15 else 0
	return float(different) / (one.get_width() * one.get_height())

func drawn(name):
	for i in 4:
		await process_frame
	var image = Host.picture(get_root())
	image.save_png(OS.get_environment("HF_PICTURE").get_basename() + "_" + name + ".png")
	return image

func _initialize():
	var scene = load("res://model.glb").instantiate()
	var given = Deformer.mesh_in(scene)
	scene.free()
	# the deformer makes the surface and writes vertices; beside it the GPU poses the same surface
	var deformer = Deformer.new()
	deformer.mesh = given
	get_root().add_child(deformer)
	if not deformer.bind():
		quit(1)
		return
	var surface = deformer.surface
	var box = given.get_aabb()
	var size = box.size.length()
	var points = deformer.arrays[Mesh.ARRAY_VERTEX]
	var front = 0
	for i in points.size():
		if points[i].z > points[front].z:
			front = i
	var trunk = surface.add_handle_at(box.position + box.size * Vector3(0.5, 0.6, 0.4), 0.3 * size)
	var head = surface.add_handle_at(points[front], 0.1 * size)
	var blended = Blended.new()
	blended.mesh = given
	get_root().add_child(blended)
	var light = DirectionalLight3D.new()
	light.rotation_degrees = Vector3(-40, 30, 0)
	get_root().add_child(light)
	var camera = Camera3D.new()
	get_root().add_child(camera)
	camera.look_at_from_position(box.get_center() + Vector3(0.4, 0.2, 0.46) * size, box.get_center(), Vector3.UP)
	camera.current = true
	deformer.visible = false
	var good = trunk != null and head != null and blended.bind(surface)
	var rest = await drawn("rest")
	surface.set_transform(head, [sin(-0.25), 0, 0, cos(0.25)], Vector3(0.08, 0.1, -0.02) * size)
	var box_at_rest = blended.custom_aabb
	good = blended.update() and good
	var by_shader = await drawn("shader")
	# the same frame by vertices
	var arrays = blended.rest.duplicate()
	arrays[Mesh.ARRAY_VERTEX] = surface.deform({"iteration_count": 1})
	# what culls holds every vertex of the frame, and follows the pose
	var holds = blended.custom_aabb != box_at_rest
	for vertex in arrays[Mesh.ARRAY_VERTEX]:
		holds = holds and blended.custom_aabb.grow(1e-4 * size).has_point(vertex)
	arrays[Mesh.ARRAY_NORMAL] = surface.normals()
	arrays[Mesh.ARRAY_BONES] = null
	arrays[Mesh.ARRAY_WEIGHTS] = null
	deformer.mesh = ArrayMesh.new()
	deformer.mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var plain = ShaderMaterial.new()
	plain.shader = Shader.new()
	plain.shader.code = Blended.SHADER.replace("#include \"res://addons/hf/hf_blend.gdshaderinc\"", "")
	deformer.material_override = plain
	deformer.visible = true
	blended.visible = false
	var by_vertices = await drawn("vertices")
	var moved = apart(rest, by_shader)
	var off = apart(by_shader, by_vertices)
	# another surface of the same mesh, whose revisions are those of the first: its rows are uploaded
	var before = blended.mesh
	var other = Deformer.new()
	other.mesh = given
	get_root().add_child(other)
	good = other.bind() and good
	for point in [box.position + box.size * Vector3(0.5, 0.6, 0.4), points[front]]:
		good = other.surface.add_handle_at(point, 0.2 * size) != null and good
	good = blended.bind(other.surface) and blended.mesh != before and good
	print("blended: moved ", moved, ", off ", off, ", holds ", holds)
	quit(0 if good and holds and moved > 0.02 and off < 0.002 else 1)
