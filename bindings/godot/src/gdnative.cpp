// Godot 3: HfSurface as a NativeScript class over GDNative's C interface. Godot's values become hf_godot::Argument and
// back.
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
      // other items become NaN, which the library refuses by their place
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
  } else if (type == GODOT_VARIANT_TYPE_STRING) {
    argument.text = text_of(value);
  } else if (type == GODOT_VARIANT_TYPE_VECTOR3) {
    const godot_vector3 v = api->godot_variant_as_vector3(value);
    for (int c = 0; c < 3; ++c)
      argument.list.push_back(api->godot_vector3_get_axis(&v, static_cast<godot_vector3_axis>(c)));
  } else if (type == GODOT_VARIANT_TYPE_QUAT) {
    const godot_quat q = api->godot_variant_as_quat(value);
    argument.list = {api->godot_quat_get_x(&q), api->godot_quat_get_y(&q), api->godot_quat_get_z(&q),
                     api->godot_quat_get_w(&q)};
  } else if (type == GODOT_VARIANT_TYPE_OBJECT) {
    godot_object* object = api->godot_variant_as_object(value);
    auto* instance = object ? static_cast<Instance*>(script->godot_nativescript_get_userdata(object)) : nullptr;
    if (instance && instance->tag == tag) argument.surface = instance->surface;
  } else if (type == GODOT_VARIANT_TYPE_DICTIONARY) {
    godot_dictionary dictionary = api->godot_variant_as_dictionary(value);
    godot_array keys = api->godot_dictionary_keys(&dictionary);
    for (godot_int i = 0; i < api->godot_array_size(&keys); ++i) {
      const godot_variant* key = api->godot_array_operator_index_const(&keys, i);
      argument.named[text_of(key)] =
          api->godot_variant_as_real(api->godot_dictionary_operator_index_const(&dictionary, key));
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
    const bool nested = first && (api->godot_variant_get_type(first) == GODOT_VARIANT_TYPE_ARRAY ||
                                  api->godot_variant_get_type(first) == GODOT_VARIANT_TYPE_POOL_INT_ARRAY);
    for (godot_int i = 0; nested && i < size; ++i)
      numbers_of(api->godot_array_operator_index_const(&array, i), argument.lists.emplace_back());
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

// One kind of Godot's typed arrays: its functions, and how many floats an element has.
struct Pool {
  template <class Array, class Access, class Element, class Number>
  static godot_variant variant(void (*make)(Array*), void (*resize)(Array*, godot_int), Access* (*write)(Array*),
                               Element* (*place)(const Access*), void (*release)(Access*),
                               void (*wrap)(godot_variant*, const Array*), void (*destroy)(Array*),
                               const std::vector<Number>& numbers) {
    Array pool;
    make(&pool);
    resize(&pool, static_cast<godot_int>(numbers.size() * sizeof(Number) / sizeof(Element)));
    Access* access = write(&pool);
    if (!numbers.empty())
      std::memcpy(static_cast<void*>(place(access)), numbers.data(), numbers.size() * sizeof(Number));
    release(access);
    godot_variant value;
    wrap(&value, &pool);
    destroy(&pool);
    return value;
  }
};

godot_variant integers_variant(const Numbers& numbers) {
  return Pool::variant(api->godot_pool_int_array_new, api->godot_pool_int_array_resize, api->godot_pool_int_array_write,
                       api->godot_pool_int_array_write_access_ptr, api->godot_pool_int_array_write_access_destroy,
                       api->godot_variant_new_pool_int_array, api->godot_pool_int_array_destroy, numbers);
}
godot_variant reals_variant(const std::vector<float>& numbers) {
  return Pool::variant(api->godot_pool_real_array_new, api->godot_pool_real_array_resize,
                       api->godot_pool_real_array_write, api->godot_pool_real_array_write_access_ptr,
                       api->godot_pool_real_array_write_access_destroy, api->godot_variant_new_pool_real_array,
                       api->godot_pool_real_array_destroy, numbers);
}
godot_variant vectors_variant(const std::vector<float>& numbers) {
  return Pool::variant(api->godot_pool_vector3_array_new, api->godot_pool_vector3_array_resize,
                       api->godot_pool_vector3_array_write, api->godot_pool_vector3_array_write_access_ptr,
                       api->godot_pool_vector3_array_write_access_destroy, api->godot_variant_new_pool_vector3_array,
                       api->godot_pool_vector3_array_destroy, numbers);
}
godot_variant bytes_variant(const std::vector<uint8_t>& bytes) {
  return Pool::variant(api->godot_pool_byte_array_new, api->godot_pool_byte_array_resize,
                       api->godot_pool_byte_array_write, api->godot_pool_byte_array_write_access_ptr,
                       api->godot_pool_byte_array_write_access_destroy, api->godot_variant_new_pool_byte_array,
                       api->godot_pool_byte_array_destroy, bytes);
}
godot_variant named_variant(const std::map<std::string, double>& fields) {
  godot_dictionary dictionary;
  api->godot_dictionary_new(&dictionary);
  for (const auto& [name, number] : fields) set_field(dictionary, name, real_variant(number));
  godot_variant value;
  api->godot_variant_new_dictionary(&value, &dictionary);
  api->godot_dictionary_destroy(&dictionary);
  return value;
}

// A list of what `each` makes of the items.
template <class Item>
godot_variant list_variant(const std::vector<Item>& items, godot_variant (*each)(const Item&)) {
  godot_array array;
  api->godot_array_new(&array);
  for (const Item& item : items) {
    godot_variant element = each(item);
    api->godot_array_append(&array, &element);
    api->godot_variant_destroy(&element);
  }
  godot_variant value;
  api->godot_variant_new_array(&value, &array);
  api->godot_array_destroy(&array);
  return value;
}

godot_variant variant_of(const Value& result) {
  godot_variant value;
  switch (result.kind) {
    case Value::truth:
      return api->godot_variant_new_bool(&value, true), value;
    case Value::number:
      return real_variant(result.real);
    case Value::integers:
      return integers_variant(result.whole);
    case Value::reals:
      return reals_variant(result.floats);
    case Value::vectors:
      return vectors_variant(result.floats);
    case Value::bytes:
      return bytes_variant(result.octets);
    case Value::named:
      return named_variant(result.fields);
    case Value::rows:
      return list_variant(result.table, named_variant);
    case Value::lists:
      return list_variant(result.sets, integers_variant);
    case Value::lines:
      return list_variant(result.polylines, vectors_variant);
    case Value::nothing:
      break;
  }
  api->godot_variant_new_nil(&value);
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
    if (api->extensions[i]->type == GDNATIVE_EXT_NATIVESCRIPT)
      script = reinterpret_cast<const godot_gdnative_ext_nativescript_api_struct*>(api->extensions[i]);
  }
}

void GDN_EXPORT godot_gdnative_terminate(godot_gdnative_terminate_options*) {
  api = nullptr;
  script = nullptr;
}

void GDN_EXPORT godot_nativescript_init(void* handle) {
  script->godot_nativescript_register_class(handle, "HfSurface", "Reference", {make_instance, nullptr, nullptr},
                                            {free_instance, nullptr, nullptr});
  for (const Entry& entry : methods()) {
    script->godot_nativescript_register_method(handle, "HfSurface", entry.name, {GODOT_METHOD_RPC_MODE_DISABLED},
                                               {call_method, const_cast<Entry*>(&entry), nullptr});
  }
  script->godot_nativescript_register_method(handle, "HfSurface", "get_error", {GODOT_METHOD_RPC_MODE_DISABLED},
                                             {get_error, nullptr, nullptr});
}
}
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
