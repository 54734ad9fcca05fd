"""Installs the add-on of HF_ADDON_ZIP into this Blender, as an extension where Blender has these."""

import importlib
import os

import bpy

EXTENSION = bpy.app.version >= (4, 2, 0)  # the same zip is an extension there
MODULE = "bl_ext.user_default.hf_blender" if EXTENSION else "hf_blender"

if EXTENSION:
    if "user_default" not in [repo.module for repo in bpy.context.preferences.extensions.repos]:
        bpy.context.preferences.extensions.repos.new(name="User Default", module="user_default")
    bpy.ops.extensions.package_install_files(filepath=os.environ["HF_ADDON_ZIP"], repo="user_default", enable_on_install=True)
else:
    bpy.ops.preferences.addon_install(filepath=os.environ["HF_ADDON_ZIP"])
    bpy.ops.preferences.addon_enable(module=MODULE)
assert MODULE in bpy.context.preferences.addons, "the add-on is not enabled"


def modules(*names):
    """Modules of the add-on."""
    return [importlib.import_module(f"{MODULE}.{name}") for name in names]


def disable():
    bpy.ops.preferences.addon_disable(module=MODULE)
