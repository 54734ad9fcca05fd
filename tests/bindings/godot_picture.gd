# A picture of a glb, at rest and posed by hf_deformer.gd: godot --path PROJECT -s picture.gd, under Xvfb; writes
# $HF_PICTURE. For Godot 3 bindings/godot/godot3.sed changes some words.
extends SceneTree

const Deformer = preload("res://addons/hf/hf_deformer.gd")
const Host = preload("res://host.gd")

# Pixels of a half of the picture that are not background, those of them that no shade makes dark, and those that differ
# from an earlier picture.
func counts(image, earlier, half):
	var drawn = 0
	var lit = 0
	var moved = 0
	var background = image.get_pixel(0, 0)
	var width = image.get_width() / 2
	for y in image.get_height():
		for x in range(half * width, (half + 1) * width):
			var pixel = image.get_pixel(x, y)
			drawn += 1 if apart(pixel, background) > 0.1 else 0
			lit += 1 if apart(pixel, background) > 0.1 and pixel.r > 0.3 else 0
			moved += 1 if apart(pixel, earlier.get_pixel(x, y)) > 0.1 else 0
	return {"drawn": drawn, "lit": lit, "moved": moved}

func apart(a, b):
	return abs(a.r - b.r) + abs(a.g - b.g) + abs(a.b - b.b)

func shown():
	var scene = load("res://model.glb").instantiate()
	var deformer = Deformer.new()
	deformer.mesh = Deformer.mesh_in(scene)
	scene.free()
	get_root().add_child(deformer)
	return deformer

func _initialize():
	var light = DirectionalLight3D.new()
	light.rotation_degrees = Vector3(-40, 30, 0)
	light.light_energy = 3
	get_root().add_child(light)
	var rest = shown()
	var posed = shown()
	if not posed.bind():
		quit(1)
		return
	var points = posed.arrays[Mesh.ARRAY_VERTEX]
	var box = AABB(points[0], Vector3())
	var front = 0
	for i in points.size():
		box = box.expand(points[i])
		if points[i].z > points[front].z:
			front = i
	var size = box.size.length()
	rest.transform.origin = Vector3(-0.3 * size, 0, 0)
	posed.transform.origin = Vector3(0.3 * size, 0, 0)
	var environment = WorldEnvironment.new()
	environment.environment = Environment.new()
	environment.environment.background_mode = Environment.BG_COLOR
	environment.environment.background_color = Color(0.25, 0.27, 0.3)
	environment.environment.ambient_light_color = Color(0.3, 0.3, 0.3)
	get_root().add_child(environment)
	var camera = Camera3D.new()
	get_root().add_child(camera)
	camera.look_at_from_position(Vector3(0.75 * size, 0.45 * size, 0.95 * size), box.position + 0.5 * box.size, Vector3.UP)
	camera.current = true
	var trunk = posed.add_handle(box.position + box.size * Vector3(0.5, 0.6, 0.4), 0.3 * size)
	var head = posed.add_handle(points[front], 0.1 * size)
	if trunk == null or head == null:
		quit(1)
		return
	for i in 6:
		await process_frame
	var earlier = Host.picture(get_root())
	head.transform.origin += Vector3(0.08 * size, 0.1 * size, -0.02 * size)
	head.rotate_x(-0.4)
	for i in 16:
		await process_frame
	var image = Host.picture(get_root())
	image.save_png(OS.get_environment("HF_PICTURE"))
	var left = counts(image, earlier, 0)
	var right = counts(image, earlier, 1)
	print("picture: ", image.get_width(), " x ", image.get_height(), ", left: ", left, ", right: ", right)
	# two animals in the light, of which the right one has moved; its muzzle was in the left half
	var good = min(left.lit, right.lit) > 3000 and right.moved > 2000 and 5 * left.moved < right.moved
	quit(0 if good else 1)
