# The second block of bindings/godot/README.md on a torus with sites and handles: godot --headless --path PROJECT -s FILE
extends SceneTree

func torus(surface):
	var positions = []
	var triangles = []
	for i in range(48):
		for j in range(24):
			var u = i * 2 * PI / 48
			var v = (j + 6) * 2 * PI / 24  # vertex 0 faces up
			positions.append(Vector3((1 + 0.4 * cos(v)) * cos(u), (1 + 0.4 * cos(v)) * sin(u), 0.4 * sin(v)))
			var right = (i + 1) % 48 * 24
			var up = (j + 1) % 24
			triangles += [24 * i + j, right + j, right + up, 24 * i + j, right + up, 24 * i + up]
	return surface.create(PackedVector3Array(positions), PackedInt32Array(triangles))

func _initialize():
	var surface = HfSurface.new()
	torus(surface)
	surface.add_sites([0, 1, 600, 700], [0, 0.2, 1, 0.7])
	surface.add_handles([[0, 1, 2], [600, 601, 602]])
	surface.deform()
@BLOCK@
	var missing = 0
	var results = {"lines": lines, "faces": faces, "crosses": crosses, "found": found, "smooth": smooth, "bones": bones, "corners": corners}
	for name in results:
		if results[name] == null or results[name].is_empty():
			printerr(name, " of the README came back empty; the last error: ", surface.get_error())
			missing += 1
	if missing == 0 and crosses.size() == 1152 and smooth.size() == 1152 and surface.solve().size() == 1154:
		print("README: all calls answered")
	quit()
