// Godot 4: HfSurface as a GDExtension class by godot-cpp, over the same surface*.cpp. It was compiled and linked with
// godot-cpp 4.3; the tests compile it against stand-ins (tests/bindings/godot_cpp_stubs.h). It has never run in Godot 4.
// Entry symbol: hf_godot_init.
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
  // invoke(name, [arguments...]): every method by its name, as HfSurface of Godot 3 has them.
  Variant invoke(const String& name, const Array& values) {
    const std::string wanted = name.utf8().get_data();
    for (const hf_godot::Entry& entry : hf_godot::methods()) {
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
    } else if (value.get_type() == Variant::VECTOR3) {
      const Vector3 v = value;
      argument.list = {v.x, v.y, v.z};
    } else if (value.get_type() == Variant::QUATERNION) {
      const Quaternion q = value;
      argument.list = {q.x, q.y, q.z, q.w};
    } else if (value.get_type() == Variant::OBJECT) {
      if (HfSurface* other = Object::cast_to<HfSurface>(value)) argument.surface = other->surface_;
    } else if (value.get_type() == Variant::DICTIONARY) {
      const Dictionary named = value;
      const Array keys = named.keys();
      for (int i = 0; i < keys.size(); ++i) {
        const String key = keys[i];
        argument.named[key.utf8().get_data()] = named[keys[i]];
      }
    } else if (value.get_type() == Variant::PACKED_BYTE_ARRAY) {
      const PackedByteArray bytes = value;
      argument.bytes.assign(bytes.ptr(), bytes.ptr() + bytes.size());
    } else {
      const Array list = value;
      if (list.size() > 0 &&
          (list[0].get_type() == Variant::ARRAY || list[0].get_type() == Variant::PACKED_INT32_ARRAY)) {
        for (int i = 0; i < list.size(); ++i) numbers_of(list[i], argument.lists.emplace_back());
      } else {
        numbers_of(value, argument.list);
      }
    }
    return argument;
  }

  template <class Packed, class Number>
  static Packed packed(const std::vector<Number>& numbers) {
    Packed out;
    out.resize(static_cast<int64_t>(numbers.size()));
    for (size_t i = 0; i < numbers.size(); ++i) out.set(static_cast<int64_t>(i), numbers[i]);
    return out;
  }
  static PackedVector3Array vectors_of(const std::vector<float>& floats) {
    PackedVector3Array out;
    out.resize(static_cast<int64_t>(floats.size() / 3));
    for (size_t i = 0; i + 2 < floats.size(); i += 3)
      out.set(static_cast<int64_t>(i / 3), Vector3(floats[i], floats[i + 1], floats[i + 2]));
    return out;
  }
  static PackedInt32Array integers_of(const hf_godot::Numbers& numbers) { return packed<PackedInt32Array>(numbers); }
  static Dictionary named_of(const std::map<std::string, double>& fields) {
    Dictionary out;
    for (const auto& [name, number] : fields) out[String(name.c_str())] = number;
    return out;
  }
  template <class Item, class Made>
  static Array list_of(const std::vector<Item>& items, Made (*each)(const Item&)) {
    Array out;
    for (const Item& item : items) out.push_back(each(item));
    return out;
  }

  static Variant variant_of(const hf_godot::Value& value) {
    using Value = hf_godot::Value;
    switch (value.kind) {
      case Value::truth:
        return true;
      case Value::number:
        return value.real;
      case Value::integers:
        return integers_of(value.whole);
      case Value::reals:
        return packed<PackedFloat32Array>(value.floats);
      case Value::vectors:
        return vectors_of(value.floats);
      case Value::bytes:
        return packed<PackedByteArray>(value.octets);
      case Value::named:
        return named_of(value.fields);
      case Value::rows:
        return list_of(value.table, named_of);
      case Value::lists:
        return list_of(value.sets, integers_of);
      case Value::lines:
        return list_of(value.polylines, vectors_of);
      case Value::nothing:
        break;
    }
    return Variant();
  }

  std::shared_ptr<hf_godot::Surface> surface_ = std::make_shared<hf_godot::Surface>();
};

extern "C" GDExtensionBool GDE_EXPORT hf_godot_init(GDExtensionInterfaceGetProcAddress address,
                                                    GDExtensionClassLibraryPtr library,
                                                    GDExtensionInitialization* initialization) {
  GDExtensionBinding::InitObject init(address, library, initialization);
  init.register_initializer([](ModuleInitializationLevel level) {
    if (level == MODULE_INITIALIZATION_LEVEL_SCENE) ClassDB::register_class<HfSurface>();
  });
  init.register_terminator([](ModuleInitializationLevel) {});
  init.set_minimum_library_initialization_level(MODULE_INITIALIZATION_LEVEL_SCENE);
  return init.init();
}
