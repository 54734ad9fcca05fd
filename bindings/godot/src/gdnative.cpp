// Godot 3: HfSurface as a NativeScript class over GDNative's C interface. Godot's values become hf_godot::Argument and back.
#include <gdnative_api_struct.gen.h>

#include <cstring>
#include <limits>

#include "surface.h"

using namespace hf_godot;

namespace {

const godot_gdnative_core_api_struct* api = nullptr;
const godot_gdnative_ext_nativescript_api_struct* script = nullptr;
const void* const tag = &api;  // tells our instances from others

struct Instance {
  const void* tag;
  std::shared_ptr<Surface> surface;
};

std::string text_of(const godot_variant* value) {
  godot_string string = api->godot_variant_as_string(value);
  godot_char_string utf8 = api->godot_string_utf8(&string);
  std::string text(api->godot_char_string_get_data(&utf8), static_cast<size_t>(api->godot_char_string_length(&utf8)));
  api->godot_char_string_destroy(&utf8);
  api->godot_string_destroy(&string);
  return text;
}

bool is_number(const godot_variant* value) {
  const godot_variant_type type = api->godot_variant_get_type(value);
  return type == GODOT_VARIANT_TYPE_REAL || type == GODOT_VARIANT_TYPE_INT || type == GODOT_VARIANT_TYPE_BOOL;
}

// Any list of numbers or vectors.
void numbers_of(const godot_variant* value, Doubles& out) {
  if (api->godot_variant_get_type(value) == GODOT_VARIANT_TYPE_POOL_VECTOR3_ARRAY) {
    godot_pool_vector3_array pool = api->godot_variant_as_pool_vector3_array(value);
    godot_pool_vector3_array_read_access* access = api->godot_pool_vector3_array_read(&pool);
    const auto* floats = reinterpret_cast<const float*>(api->godot_pool_vector3_array_read_access_ptr(access));
    out.assign(floats, floats + 3 * api->godot_pool_vector3_array_size(&pool));
    api->godot_pool_vector3_array_read_access_destroy(access);
    api->godot_pool_vector3_array_destroy(&pool);
    return;
  }
  godot_array array = api->godot_variant_as_array(value);
  const godot_int size = api->godot_array_size(&array);
  out.reserve(static_cast<size_t>(size));
  for (godot_int i = 0; i < size; ++i) {
    const godot_variant* item = api->godot_array_operator_index_const(&array, i);
    if (api->godot_variant_get_type(item) == GODOT_VARIANT_TYPE_VECTOR3) {
      const godot_vector3 v = api->godot_variant_as_vector3(item);
      for (int c = 0; c < 3; ++c) out.push_back(api->godot_vector3_get_axis(&v, static_cast<godot_vector3_axis>(c)));
    } else {
      // what is no number becomes NaN, which the library refuses by its place
      out.push_back(is_number(item) ? api->godot_variant_as_real(item) : std::numeric_limits<double>::quiet_NaN());
    }
  }
  api->godot_array_destroy(&array);
}

Argument argument_of(const godot_variant* value) {
  Argument argument;
  const godot_variant_type type = api->godot_variant_get_type(value);
  argument.null = type == GODOT_VARIANT_TYPE_NIL;
  if (argument.null) return argument;
  if (is_number(value)) {
    argument.number = api->godot_variant_as_real(value);
  } else if (type == GODOT_VARIANT_TYPE_OBJECT) {
    godot_object* object = api->godot_variant_as_object(value);
    auto* instance = object ? static_cast<Instance*>(script->godot_nativescript_get_userdata(object)) : nullptr;
    if (instance && instance->tag == tag) argument.surface = instance->surface;
  } else if (type == GODOT_VARIANT_TYPE_DICTIONARY) {
    godot_dictionary dictionary = api->godot_variant_as_dictionary(value);
    godot_array keys = api->godot_dictionary_keys(&dictionary);
    for (godot_int i = 0; i < api->godot_array_size(&keys); ++i) {
      const godot_variant* key = api->godot_array_operator_index_const(&keys, i);
      argument.named[text_of(key)] = api->godot_variant_as_real(api->godot_dictionary_operator_index_const(&dictionary, key));
    }
    api->godot_array_destroy(&keys);
    api->godot_dictionary_destroy(&dictionary);
  } else if (type == GODOT_VARIANT_TYPE_POOL_BYTE_ARRAY) {
    godot_pool_byte_array pool = api->godot_variant_as_pool_byte_array(value);
    godot_pool_byte_array_read_access* access = api->godot_pool_byte_array_read(&pool);
    const uint8_t* bytes = api->godot_pool_byte_array_read_access_ptr(access);
    argument.bytes.assign(bytes, bytes + api->godot_pool_byte_array_size(&pool));
    api->godot_pool_byte_array_read_access_destroy(access);
    api->godot_pool_byte_array_destroy(&pool);
  } else if (type == GODOT_VARIANT_TYPE_ARRAY) {
    godot_array array = api->godot_variant_as_array(value);
    const godot_int size = api->godot_array_size(&array);
    const godot_variant* first = size > 0 ? api->godot_array_operator_index_const(&array, 0) : nullptr;
    const bool nested = first && (api->godot_variant_get_type(first) == GODOT_VARIANT_TYPE_ARRAY || api->godot_variant_get_type(first) == GODOT_VARIANT_TYPE_POOL_INT_ARRAY);
    for (godot_int i = 0; nested && i < size; ++i) numbers_of(api->godot_array_operator_index_const(&array, i), argument.lists.emplace_back());
    api->godot_array_destroy(&array);
    if (!nested) numbers_of(value, argument.list);
  } else {
    numbers_of(value, argument.list);
  }
  return argument;
}

godot_variant text_variant(const std::string& text) {
  godot_string string;
  api->godot_string_new(&string);
  api->godot_string_parse_utf8(&string, text.c_str());
  godot_variant value;
  api->godot_variant_new_string(&value, &string);
  api->godot_string_destroy(&string);
  return value;
}

void set_field(godot_dictionary& dictionary, const std::string& name, godot_variant value) {
  godot_variant key = text_variant(name);
  api->godot_dictionary_set(&dictionary, &key, &value);
  api->godot_variant_destroy(&key);
  api->godot_variant_destroy(&value);
}

godot_variant real_variant(double number) {
  godot_variant value;
  api->godot_variant_new_real(&value, number);
  return value;
}

godot_variant variant_of(const Value& result) {
  godot_variant value;
  api->godot_variant_new_nil(&value);
  if (result.kind == Value::truth) {
    api->godot_variant_new_bool(&value, true);
  } else if (result.kind == Value::number) {
    api->godot_variant_new_real(&value, result.real);
  } else if (result.kind == Value::integers) {
    godot_pool_int_array pool;
    api->godot_pool_int_array_new(&pool);
    for (uint32_t number : result.whole) api->godot_pool_int_array_append(&pool, static_cast<godot_int>(number));
    api->godot_variant_new_pool_int_array(&value, &pool);
    api->godot_pool_int_array_destroy(&pool);
  } else if (result.kind == Value::reals) {
    godot_pool_real_array pool;
    api->godot_pool_real_array_new(&pool);
    api->godot_pool_real_array_resize(&pool, static_cast<godot_int>(result.floats.size()));
    godot_pool_real_array_write_access* access = api->godot_pool_real_array_write(&pool);
    if (!result.floats.empty()) std::memcpy(api->godot_pool_real_array_write_access_ptr(access), result.floats.data(), result.floats.size() * sizeof(float));
    api->godot_pool_real_array_write_access_destroy(access);
    api->godot_variant_new_pool_real_array(&value, &pool);
    api->godot_pool_real_array_destroy(&pool);
  } else if (result.kind == Value::vectors) {
    godot_pool_vector3_array pool;
    api->godot_pool_vector3_array_new(&pool);
    api->godot_pool_vector3_array_resize(&pool, static_cast<godot_int>(result.floats.size() / 3));
    godot_pool_vector3_array_write_access* access = api->godot_pool_vector3_array_write(&pool);
    if (!result.floats.empty()) std::memcpy(static_cast<void*>(api->godot_pool_vector3_array_write_access_ptr(access)), result.floats.data(), result.floats.size() * sizeof(float));
    api->godot_pool_vector3_array_write_access_destroy(access);
    api->godot_variant_new_pool_vector3_array(&value, &pool);
    api->godot_pool_vector3_array_destroy(&pool);
  } else if (result.kind == Value::bytes) {
    godot_pool_byte_array pool;
    api->godot_pool_byte_array_new(&pool);
    api->godot_pool_byte_array_resize(&pool, static_cast<godot_int>(result.octets.size()));
    godot_pool_byte_array_write_access* access = api->godot_pool_byte_array_write(&pool);
    if (!result.octets.empty()) std::memcpy(api->godot_pool_byte_array_write_access_ptr(access), result.octets.data(), result.octets.size());
    api->godot_pool_byte_array_write_access_destroy(access);
    api->godot_variant_new_pool_byte_array(&value, &pool);
    api->godot_pool_byte_array_destroy(&pool);
  } else if (result.kind == Value::named) {
    godot_dictionary dictionary;
    api->godot_dictionary_new(&dictionary);
    for (const auto& [name, number] : result.fields) set_field(dictionary, name, real_variant(number));
    api->godot_variant_new_dictionary(&value, &dictionary);
    api->godot_dictionary_destroy(&dictionary);
  }
  return value;
}

void* make_instance(godot_object*, void*) { return new Instance{tag, std::make_shared<Surface>()}; }
void free_instance(godot_object*, void*, void* instance) { delete static_cast<Instance*>(instance); }

godot_variant call_method(godot_object*, void* method, void* instance, int count, godot_variant** values) {
  Surface& surface = *static_cast<Instance*>(instance)->surface;
  Arguments arguments;
  for (int i = 0; i < count; ++i) arguments.push_back(argument_of(values[i]));
  return variant_of(call(surface, *static_cast<const Entry*>(method), arguments));
}

// { name, message, index } of the last call when it failed, empty otherwise.
godot_variant get_error(godot_object*, void*, void* instance, int, godot_variant**) {
  const Surface& surface = *static_cast<Instance*>(instance)->surface;
  godot_dictionary dictionary;
  api->godot_dictionary_new(&dictionary);
  if (!surface.error_name.empty()) {
    set_field(dictionary, "name", text_variant(surface.error_name));
    set_field(dictionary, "message", text_variant(surface.error_message));
    set_field(dictionary, "index", real_variant(surface.error_index));
  }
  godot_variant value;
  api->godot_variant_new_dictionary(&value, &dictionary);
  api->godot_dictionary_destroy(&dictionary);
  return value;
}

}  // namespace

#if defined(__GNUC__)
#pragma GCC visibility push(default)  // GDN_EXPORT is empty here
#endif
extern "C" {

void GDN_EXPORT godot_gdnative_init(godot_gdnative_init_options* options) {
  api = options->api_struct;
  for (unsigned i = 0; i < api->num_extensions; ++i) {
    if (api->extensions[i]->type == GDNATIVE_EXT_NATIVESCRIPT) script = reinterpret_cast<const godot_gdnative_ext_nativescript_api_struct*>(api->extensions[i]);
  }
}

void GDN_EXPORT godot_gdnative_terminate(godot_gdnative_terminate_options*) { api = nullptr, script = nullptr; }

void GDN_EXPORT godot_nativescript_init(void* handle) {
  script->godot_nativescript_register_class(handle, "HfSurface", "Reference", {make_instance, nullptr, nullptr}, {free_instance, nullptr, nullptr});
  for (const Entry& entry : methods) {
    script->godot_nativescript_register_method(handle, "HfSurface", entry.name, {GODOT_METHOD_RPC_MODE_DISABLED}, {call_method, const_cast<Entry*>(&entry), nullptr});
  }
  script->godot_nativescript_register_method(handle, "HfSurface", "get_error", {GODOT_METHOD_RPC_MODE_DISABLED}, {get_error, nullptr, nullptr});
}
}
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
