# The extension is taken out of a running Godot 4 and put back: the class goes, and so does the library's memory.
extends SceneTree

const EXTENSION = "res://addons/hf/hf.gdextension"

func places_of_library():
	var file = FileAccess.open("/proc/self/maps", FileAccess.READ)
	var places = 0
	var line = file.get_line()
	while line != "":
		places += 1 if "hf_godot4" in line else 0
		line = file.get_line()
	return places

func _initialize():
	var wrong = 0
	for round_ in 3:
		var surface = ClassDB.instantiate("HfSurface")
		var made = surface.create(PackedVector3Array([Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)]), PackedInt32Array([0, 1, 2]))
		surface = null
		wrong += 0 if made and places_of_library() > 0 else 1
		wrong += 0 if GDExtensionManager.unload_extension(EXTENSION) == GDExtensionManager.LOAD_STATUS_OK else 1
		wrong += 1 if ClassDB.class_exists("HfSurface") or places_of_library() > 0 else 0
		wrong += 0 if GDExtensionManager.load_extension(EXTENSION) == GDExtensionManager.LOAD_STATUS_OK else 1
	print("unloaded 3 times" if wrong == 0 else "%d steps went wrong" % wrong)
	quit(1 if wrong > 0 else 0)
