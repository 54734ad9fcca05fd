# A MeshInstance3D whose mesh follows handles: nodes given by add_handle(), which may be added and removed at any time.
#
#   var deformer = preload("res://addons/hf/hf_deformer.gd").new()
#   deformer.mesh = some_mesh
#   add_child(deformer)
#   deformer.bind()
#   var head = deformer.add_handle(Vector3(0, 1.2, 0.4), 0.2)   # a Node3D: move it
#
# A handle that is moved and was never turned has a free rotation: the pose finds it, as a wrist follows a hand. A node that
# is turned gives the rotation from then on, from where the handle stands; free_rotation(head) frees it again.
# set_following(head, 0.25) says how much of the body follows; keep_lengths(head) keeps the lengths of its limb.
# attach(vertex, radius) links a piece of the mesh to what is nearest to it: a sword that stands in the hand at rest. detach(vertex)
# lets it go.
extends MeshInstance3D

const Joints = preload("res://addons/hf/hf_retarget.gd")

var surface = null
# Node3D -> { number, rest, layer, seen: the transform of the last update, free, given: the node was turned, turn: the rotation
# of the handle where the node has none, following, limb: the steps that keep its lengths }
var handles = {}
var arrays = []
var triangles = null # counter-clockwise
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

# The fewest steps with which hf_pose_set_limb_refine keeps lengths.
const LENGTH_STEPS = 8

# Makes the surface, which factorises once. Returns true, or false with a warning that says why not.
func bind(options = {}):
	surface = HfSurface.new()
	arrays = mesh.surface_get_arrays(0)
	var corners = arrays[Mesh.ARRAY_INDEX]
	if corners == null:
		corners = range(arrays[Mesh.ARRAY_VERTEX].size())
	# Godot's triangles are clockwise, the library's counter-clockwise
	triangles = PackedInt32Array(corners)
	for i in range(0, triangles.size(), 3):
		var keep = triangles[i + 1]
		triangles[i + 1] = triangles[i + 2]
		triangles[i + 2] = keep
	return said(surface.create(arrays[Mesh.ARRAY_VERTEX], triangles, options))

func said(result):
	if result == null:
		push_warning("hf: " + surface.get_error().get("message", "not bound"))
		return false
	return true

# A handle from the vertices that are edge-connected to a point of the rest mesh within a radius. Null when refused.
# in_place: the node starts where the posed mesh stands, and the mesh stays; else both start at rest.
func add_handle(point, radius, layer = 0, in_place = false):
	var numbers = surface.add_handles_at([point], [radius], layer, in_place)
	return handle_of(numbers[0], layer, in_place) if said(numbers) else null

# The node of a handle that the surface has.
func handle_of(number, layer, in_place):
	var info = surface.handle_info(number)
	var handle = Node3D.new()
	handle.transform.origin = Vector3(info.x, info.y, info.z)
	handles[handle] = { "number": number, "rest": handle.transform, "layer": layer, "free": false, "given": false,
		"turn": Quaternion(0, 0, 0, 1), "following": 1.0, "limb": 0 }
	if in_place:
		handle.transform = Transform3D(Basis(rotation_of(info)), handle.transform.origin + Vector3(info.translation_x, info.translation_y,
			info.translation_z))
	handles[handle].seen = handle.transform
	add_child(handle)
	return handle

# Returns the rows of surface.propose_handles(). With a Skeleton3D that moves the mesh each has the name of its bone, a role
# and a side (hf/skeleton.h), and the vertices of its region: a head, a hand or a foot is whole. skin: of the MeshInstance3D
# that shows the mesh, or null where its bones are those of the skeleton. Returns null with a warning that says why not.
func propose(skeleton = null, skin = null):
	var rows = null
	if skeleton == null or arrays[Mesh.ARRAY_BONES] == null:
		rows = surface.propose_handles()
		return rows if said(rows) else null
	var joints = Joints.joints_of(skeleton)
	var numbers = arrays[Mesh.ARRAY_BONES]
	if skin != null:
		# the mesh has the frame and the unit in which the skin was bound
		var bones = []
		for bind in skin.get_bind_count():
			bones.append(bone_of(skeleton, skin, bind))
		var to_mesh = skin.get_bind_pose(0).affine_inverse() * rest_of(skeleton, bones[0]).affine_inverse()
		for bone in skeleton.get_bone_count():
			if joints[1][bone] < 0:
				Joints.put(joints[2], 10 * bone, to_mesh * skeleton.get_bone_rest(bone))
		var moved = []
		for number in numbers:
			moved.append(bones[number])
		numbers = moved
	var weights = arrays[Mesh.ARRAY_WEIGHTS]
	rows = surface.propose_handles(joints[0], joints[1], joints[2], arrays[Mesh.ARRAY_VERTEX], triangles, numbers, weights)
	if not said(rows):
		return null
	var regions = surface.proposed_regions()
	for i in rows.size():
		rows[i].bone = skeleton.get_bone_name(int(rows[i].joint)) if rows[i].joint >= 0 else ""
		rows[i].region = regions[i]
	return rows

# The bone of a bind, which Godot 4 names.
func bone_of(skeleton, skin, bind):
	var bone = skin.get_bind_bone(bind)
	if bone < 0 and skin.has_method("get_bind_name"):
		bone = skeleton.find_bone(skin.call("get_bind_name", bind))
	return max(bone, 0)

# The rest of a bone in the space of the skeleton.
func rest_of(skeleton, bone):
	var rest = skeleton.get_bone_rest(bone)
	while skeleton.get_bone_parent(bone) >= 0:
		bone = skeleton.get_bone_parent(bone)
		rest = skeleton.get_bone_rest(bone) * rest
	return rest

# Adds a handle that the library proposes. row: of propose(), or of surface.propose_handles(). Returns the node, or null with a
# warning.
func add_proposed(row):
	var handle = null
	if row.has("region"):
		var numbers = surface.add_handles([row.region])
		handle = handle_of(numbers[0], 0, false) if said(numbers) else null
	else:
		handle = add_handle(arrays[Mesh.ARRAY_VERTEX][row.vertex], row.radius)
	if handle != null and row.following < 1:
		set_following(handle, row.following)
	return handle

# Sets how much of the surface follows a handle of layer 0: 1: all of it, 0: its limb alone. Warns if it fails.
func set_following(handle, following):
	if said(surface.set_following([handles[handle].number], following)):
		handles[handle].following = following

# Keeps the lengths of the limb of a handle of layer 0: it bends like two bones. The rest of the surface stays as it is.
func keep_lengths(handle, keep = true):
	var steps = LENGTH_STEPS if keep else 0
	if said(surface.set_limb_refine([handles[handle].number], steps)):
		handles[handle].limb = steps

# One link holds a piece; three hold it at their own places. More cost more: a link costs up to six elimination paths.
const LINKS = 3

# Links a piece to the nearest vertices of other pieces, within a radius of one of its vertices: the three shortest ways. The pose
# goes on where it is, and nothing is factorised. Returns the count of links, or null with a warning.
func attach(vertex, radius):
	var piece = surface.pieces()
	var rest = arrays[Mesh.ARRAY_VERTEX]
	var own = []
	var others = []
	for v in rest.size():
		if rest[v].distance_to(rest[vertex]) <= radius and piece[v] >= 0:
			if piece[v] == piece[vertex]:
				own.append(v)
			else:
				others.append(v)
	var ways = [] # [squared length, own vertex, the nearest of another piece]
	for v in own:
		var way = [INF, v, -1]
		for other in others:
			var length = rest[v].distance_squared_to(rest[other])
			if length < way[0]:
				way = [length, v, other]
		ways.append(way)
	var links = [] # eight numbers each: a vertex, three corners, their weights, its own weight
	for _link in LINKS:
		var best = [INF, -1, -1]
		for way in ways:
			if way[0] < best[0]:
				best = way
		if best[2] >= 0:
			links += [best[1], best[2], -1, -1, 1, 0, 0, 1]
			ways.erase(best)
	if links.is_empty():
		push_warning("hf: no other piece is within %s of vertex %s" % [radius, vertex])
		return null
	return links.size() / 8 if said(surface.edit(null, null, links)) else null

# Takes out all links between the piece of a vertex and others. The piece stays where it stands: the node that is returned holds
# it there, and moves it when it is moved. Take the node away with remove_handle before the next attach. Null when refused.
func detach(vertex):
	var piece = surface.pieces()
	var numbers = []
	var rows = surface.links()
	for i in rows.size():
		for k in 3:
			if rows[i]["weight_%d" % k] > 0 and (piece[rows[i].vertex] == piece[vertex]) != (piece[rows[i]["corner_%d" % k]] == piece[vertex]):
				numbers.append(i)
				break
	var region = []
	for v in piece.size():
		if piece[v] == piece[vertex]:
			region.append(v)
	var made = surface.add_handles([region], 0, true)
	if not said(made):
		return null
	if not said(surface.edit(null, null, null, numbers)):
		surface.remove_handles(made)
		return null
	return handle_of(made[0], 0, true)

func rotation_of(info):
	return Quaternion(info.rotation_x, info.rotation_y, info.rotation_z, info.rotation_w)

func turn_of(entry, transform):
	return (transform.basis * entry.rest.basis.inverse()).get_rotation_quaternion()

# By more than single precision rounds.
func is_turned(a, b):
	return (a.x - b.x).length() + (a.y - b.y).length() + (a.z - b.z).length() > 1e-5

# The pose finds the rotation of a handle, until its node is turned.
func free_rotation(handle):
	var entry = handles[handle]
	if said(surface.set_free_rotations([entry.number], true)):
		entry.free = true
		entry.given = false

# The node gives the rotation. It begins where the handle stands.
func give_rotation(handle):
	var entry = handles[handle]
	if entry.free:
		var info = surface.handle_info(entry.number)
		if not said(info) or not said(surface.set_free_rotations([entry.number], false)):
			return
		entry.turn = turn_of(entry, entry.seen).inverse() * rotation_of(info)
		entry.free = false
	entry.given = true

# On layer 0 a move frees the rotation, a turn gives it.
func look_at_node(handle):
	var entry = handles[handle]
	if entry.layer == 0 and not entry.given:
		if is_turned(handle.transform.basis, entry.seen.basis):
			give_rotation(handle)
		elif not entry.free and not handle.transform.origin.is_equal_approx(entry.seen.origin):
			free_rotation(handle)
	entry.seen = handle.transform

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
		look_at_node(handle)
		var turn = turn_of(handles[handle], handle.transform) * handles[handle].turn
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
