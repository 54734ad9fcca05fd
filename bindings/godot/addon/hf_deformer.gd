# A MeshInstance3D whose mesh follows handles: nodes given by add_handle(), which may be added and removed at any time.
#
#   var deformer = preload("res://addons/hf/hf_deformer.gd").new()
#   deformer.mesh = some_mesh
#   add_child(deformer)
#   deformer.bind()
#   var head = deformer.add_handle(Vector3(0, 1.2, 0.4), 0.2)   # a Node3D: move it
extends MeshInstance3D


var surface = null
var handles = {} # Node3D -> { number, rest }
var arrays = []
var last = []

# The first mesh in a scene, an imported glb for one; null when there is none.
static func mesh_in(node):
	if node is MeshInstance3D:
		return node.mesh
	for child in node.get_children():
		var found = mesh_in(child)
		if found:
			return found
	return null

# Makes the surface, which factorises once. Returns true, or false with a warning that says why not.
func bind(options = {}):
	surface = HfSurface.new()
	arrays = mesh.surface_get_arrays(0)
	var triangles = arrays[Mesh.ARRAY_INDEX]
	if triangles == null:
		triangles = range(arrays[Mesh.ARRAY_VERTEX].size())
	# Godot's triangles are clockwise, the library's counter-clockwise
	var turned = PackedInt32Array(triangles)
	for i in range(0, turned.size(), 3):
		var keep = turned[i + 1]
		turned[i + 1] = turned[i + 2]
		turned[i + 2] = keep
	return said(surface.create(arrays[Mesh.ARRAY_VERTEX], turned, options))

func said(result):
	if result == null:
		push_warning("hf: " + surface.get_error().get("message", "not bound"))
		return false
	return true

# A handle from the vertices that are edge-connected to a point of the rest mesh within a radius. Null when refused.
# in_place: the node starts where the posed mesh stands, and the mesh stays; else both start at rest.
func add_handle(point, radius, layer = 0, in_place = false):
	var numbers = surface.add_handles_at([point], [radius], layer, in_place)
	if not said(numbers):
		return null
	var info = surface.handle_info(numbers[0])
	var handle = Node3D.new()
	handle.transform.origin = Vector3(info.x, info.y, info.z)
	handles[handle] = { "number": numbers[0], "rest": handle.transform }
	if in_place:
		var turn = Quaternion(info.rotation_x, info.rotation_y, info.rotation_z, info.rotation_w)
		handle.transform = Transform3D(Basis(turn), handle.transform.origin + Vector3(info.translation_x, info.translation_y,
			info.translation_z))
	add_child(handle)
	return handle

func remove_handle(handle):
	if handles.has(handle) and said(surface.remove_handles([handles[handle].number])):
		handles.erase(handle)
		handle.queue_free()

# Solves the pose and shows it; returns the positions, or null.
func update():
	if handles.is_empty():
		return null
	var numbers = []
	var turns = []
	var moves = []
	for handle in handles:
		var turn = (handle.transform.basis * handles[handle].rest.basis.inverse()).get_rotation_quaternion()
		numbers.append(handles[handle].number)
		turns += [turn.x, turn.y, turn.z, turn.w]
		var move = handle.transform.origin - handles[handle].rest.origin
		moves += [move.x, move.y, move.z]
	if not said(surface.set_transforms(numbers, turns, moves)):
		return null
	var positions = surface.deform()
	if not said(positions):
		return null
	var shown = arrays.duplicate()
	shown[Mesh.ARRAY_VERTEX] = positions
	if shown[Mesh.ARRAY_NORMAL] != null:
		shown[Mesh.ARRAY_NORMAL] = surface.normals()
	var made = ArrayMesh.new()
	made.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, shown)
	made.surface_set_material(0, mesh.surface_get_material(0))
	mesh = made
	last = positions
	return positions

func _process(_delta):
	if surface != null:
		update()
