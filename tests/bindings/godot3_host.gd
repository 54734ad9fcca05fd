# godot_host.gd for Godot 3.
extends Reference

static func text(path):
	var file = File.new()
	return file.get_as_text() if file.open(path, File.READ) == OK else ""

static func json(path):
	return JSON.parse(text(path)).result

static func first_line(path):
	var file = File.new()
	return file.get_line() if file.open(path, File.READ) == OK else ""

static func picture(viewport):
	var image = viewport.get_texture().get_data()
	image.flip_y()
	image.lock() # so that pixels can be read
	return image
