# Plays the motion of one skeleton on another, live: every frame the bones of `target` follow those of `source`.
#
#   var player = preload("res://addons/hf/hf_retarget.gd").new()
#   add_child(player)
#   player.bind(man_skeleton, robot_skeleton)   # or set source and target in the scene
#
# Animate the source as you like; nothing else may move the bones of the target. Call reset() where a clip jumps.
extends Node


@export var source: NodePath
@export var target: NodePath

var retarget = null
var from = null
var to = null
var pose = []  # of the source, 10 numbers for each bone

func _init():
	process_priority = 1  # after players of animation

func _ready():
	if retarget == null and str(source) != "" and str(target) != "":
		bind(get_node(source), get_node(target))

# Pairs the bones of two Skeleton3D once, at their rests. options: root_motion, leave_out, scale (hf/retarget.h). Returns true,
# or false with a warning that says why not.
func bind(from_skeleton, to_skeleton, options = {}):
	var made = HfSurface.new()
	var a = joints_of(from_skeleton)
	var b = joints_of(to_skeleton)
	if not said(made, made.retarget_create(a[0], a[1], a[2], b[0], b[1], b[2], options)):
		return false
	retarget = made
	from = from_skeleton
	to = to_skeleton
	pose = a[2]
	return true

func said(surface, result):
	if result == null:
		push_warning("hf: " + surface.get_error().get("message", "not bound"))
	return result != null

# Returns the names (one per line), the parents and the rests of the bones.
static func joints_of(skeleton):
	var names = ""
	var parents = []
	var rests = []
	rests.resize(10 * skeleton.get_bone_count())
	for bone in skeleton.get_bone_count():
		names += skeleton.get_bone_name(bone) + "\n"
		parents.append(skeleton.get_bone_parent(bone))
		put(rests, 10 * bone, skeleton.get_bone_rest(bone))
	return [names.trim_suffix("\n"), parents, rests]

# Writes translation, rotation x y z w and scale of a transform into a list, from position `at` on.
static func put(list, at, transform):
	var turn = transform.basis.get_rotation_quaternion()
	var size = transform.basis.get_scale()
	for k in 3:
		list[at + k] = transform.origin[k]
		list[at + 7 + k] = size[k]
	list[at + 3] = turn.x
	list[at + 4] = turn.y
	list[at + 5] = turn.z
	list[at + 6] = turn.w

# Forgets planted feet; call it where the clip jumps, after bind().
func reset():
	retarget.retarget_reset()

# Plays one frame. seconds: time since the last frame. If it fails, it warns and the target keeps its pose.
func play(seconds):
	for bone in from.get_bone_count():
		put(pose, 10 * bone, pose_of(from, bone))
	var posed = retarget.retarget_solve(pose, seconds)
	if said(retarget, posed):
		for bone in to.get_bone_count():
			var i = 10 * bone
			write(to, bone, Vector3(posed[i], posed[i + 1], posed[i + 2]), Quaternion(posed[i + 3], posed[i + 4], posed[i + 5],
				posed[i + 6]), Vector3(posed[i + 7], posed[i + 8], posed[i + 9]))

# Returns the transform of a bone relative to its parent.
func pose_of(skeleton, bone):
	return skeleton.get_bone_pose(bone)

func write(skeleton, bone, place, turn, size):
	skeleton.set_bone_pose_position(bone, place)
	skeleton.set_bone_pose_rotation(bone, turn)
	skeleton.set_bone_pose_scale(bone, size)

func _process(delta):
	if retarget != null:
		play(delta)
