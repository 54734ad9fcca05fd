# Files and pictures, which Godot 4 and 3 read by other calls. For Godot 3: godot3_host.gd.
extends RefCounted

static func json(path):
	return JSON.parse_string(FileAccess.get_file_as_string(path))

# Empty when there is no such file.
static func first_line(path):
	var file = FileAccess.open(path, FileAccess.READ) if FileAccess.file_exists(path) else null
	return file.get_line() if file else ""

static func picture(viewport):
	return viewport.get_texture().get_image()
