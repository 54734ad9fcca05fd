// Godot 4: HfSurface as a GDExtension class by godot-cpp, over the same surface.cpp. UNTESTED: no Godot 4 was to be had, this has
// never been compiled. Entry symbol: hf_godot_init.
#include <godot_cpp/classes/ref_counted.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/godot.hpp>
#include <godot_cpp/variant/variant.hpp>

#include <limits>
#include <string>

#include "surface.h"

using namespace godot;

namespace {

bool is_number(const Variant& value) {
  return value.get_type() == Variant::FLOAT || value.get_type() == Variant::INT || value.get_type() == Variant::BOOL;
}

}  // namespace

class HfSurface : public RefCounted {
  GDCLASS(HfSurface, RefCounted)

 public:
  // call(name, [arguments...]): every method of surface.cpp by its name, as HfSurface of Godot 3 has them.
  Variant invoke(const String& name, const Array& values) {
    const std::string wanted = name.utf8().get_data();
    for (const hf_godot::Entry& entry : hf_godot::methods) {
      if (wanted != entry.name) continue;
      hf_godot::Arguments arguments;
      for (int i = 0; i < values.size(); ++i) arguments.push_back(argument_of(values[i]));
      return variant_of(hf_godot::call(*surface_, entry, arguments));
    }
    return Variant();
  }

  Dictionary get_error() const {
    Dictionary error;
    if (surface_->error_name.empty()) return error;
    error["name"] = String(surface_->error_name.c_str());
    error["message"] = String::utf8(surface_->error_message.c_str());
    error["index"] = surface_->error_index;
    return error;
  }

 protected:
  static void _bind_methods() {
    ClassDB::bind_method(D_METHOD("invoke", "name", "arguments"), &HfSurface::invoke);
    ClassDB::bind_method(D_METHOD("get_error"), &HfSurface::get_error);
  }

 private:
  static void numbers_of(const Variant& value, hf_godot::Doubles& out) {
    const Array list = value;  // packed arrays convert
    for (int i = 0; i < list.size(); ++i) {
      if (list[i].get_type() == Variant::VECTOR3) {
        const Vector3 v = list[i];
        out.insert(out.end(), {v.x, v.y, v.z});
      } else {
        out.push_back(is_number(list[i]) ? static_cast<double>(list[i]) : std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

  static hf_godot::Argument argument_of(const Variant& value) {
    hf_godot::Argument argument;
    argument.null = value.get_type() == Variant::NIL;
    if (argument.null) return argument;
    if (is_number(value)) {
      argument.number = value;
    } else if (value.get_type() == Variant::OBJECT) {
      if (HfSurface* other = Object::cast_to<HfSurface>(value)) argument.surface = other->surface_;
    } else if (value.get_type() == Variant::DICTIONARY) {
      const Dictionary named = value;
      const Array keys = named.keys();
      for (int i = 0; i < keys.size(); ++i) argument.named[String(keys[i]).utf8().get_data()] = named[keys[i]];
    } else if (value.get_type() == Variant::PACKED_BYTE_ARRAY) {
      const PackedByteArray bytes = value;
      argument.bytes.assign(bytes.ptr(), bytes.ptr() + bytes.size());
    } else {
      const Array list = value;
      if (list.size() > 0 && (list[0].get_type() == Variant::ARRAY || list[0].get_type() == Variant::PACKED_INT32_ARRAY)) {
        for (int i = 0; i < list.size(); ++i) numbers_of(list[i], argument.lists.emplace_back());
      } else {
        numbers_of(value, argument.list);
      }
    }
    return argument;
  }

  static Variant variant_of(const hf_godot::Value& value) {
    using Kind = hf_godot::Value::Kind;
    if (value.kind == Kind::truth) return true;
    if (value.kind == Kind::number) return value.real;
    if (value.kind == Kind::integers) {
      PackedInt32Array out;
      for (uint32_t number : value.whole) out.push_back(static_cast<int32_t>(number));
      return out;
    }
    if (value.kind == Kind::reals) {
      PackedFloat32Array out;
      for (float number : value.floats) out.push_back(number);
      return out;
    }
    if (value.kind == Kind::vectors) {
      PackedVector3Array out;
      for (size_t i = 0; i + 2 < value.floats.size(); i += 3) out.push_back(Vector3(value.floats[i], value.floats[i + 1], value.floats[i + 2]));
      return out;
    }
    if (value.kind == Kind::bytes) {
      PackedByteArray out;
      for (uint8_t byte : value.octets) out.push_back(byte);
      return out;
    }
    if (value.kind == Kind::named) {
      Dictionary out;
      for (const auto& [name, number] : value.fields) out[String(name.c_str())] = number;
      return out;
    }
    return Variant();
  }

  std::shared_ptr<hf_godot::Surface> surface_ = std::make_shared<hf_godot::Surface>();
};

extern "C" GDExtensionBool GDE_EXPORT hf_godot_init(GDExtensionInterfaceGetProcAddress address, GDExtensionClassLibraryPtr library,
                                                    GDExtensionInitialization* initialization) {
  GDExtensionBinding::InitObject init(address, library, initialization);
  init.register_initializer([](ModuleInitializationLevel level) {
    if (level == MODULE_INITIALIZATION_LEVEL_SCENE) ClassDB::register_class<HfSurface>();
  });
  init.register_terminator([](ModuleInitializationLevel) {});
  init.set_minimum_library_initialization_level(MODULE_INITIALIZATION_LEVEL_SCENE);
  return init.init();
}
