# The third block of bindings/godot/README.md on two plates beside each other: godot --headless --path PROJECT -s FILE
extends SceneTree

const Deformer = preload("res://addons/hf/hf_deformer.gd")

func plates():
	var positions = []
	var triangles = []
	for plate in 2:
		for i in range(5):
			for j in range(5):
				positions.append(Vector3(1.01 * plate + 0.25 * j, 0.25 * i, 0))
				if i < 4 and j < 4:
					var at = 25 * plate + 5 * i + j
					triangles += [at, at + 5, at + 1, at + 1, at + 5, at + 6]
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array(positions)
	arrays[Mesh.ARRAY_INDEX] = PackedInt32Array(triangles)
	var made = ArrayMesh.new()
	made.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return made

func _initialize():
	var deformer = Deformer.new()
	deformer.mesh = plates()
	get_root().add_child(deformer)
	deformer.bind()
	deformer.add_handle(Vector3(0, 0.5, 0), 0.3)
	var hand = deformer.add_handle(Vector3(1, 0.5, 0), 0.3)
	var grip = 35
@BLOCK 3@
	for frame in range(30):
		deformer.update()
	var gap = deformer.last[grip].distance_to(deformer.last[14])
	if gap < 0.1 and deformer.surface.links().size() == 3 and deformer.last[grip].z > 0.3:
		print("README: in the hand again")
	deformer.free()
	quit()
