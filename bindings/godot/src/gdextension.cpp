// Godot 4: HfSurface as a GDExtension class over Godot's C interface (godot4.h), without godot-cpp. Godot's values
// become hf_godot::Argument and back. Entry symbol: hf_godot_init.
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

#include "godot4.h"
#include "surface.h"

using namespace hf_godot;

namespace {

godot4::Interface api;
void* library = nullptr;  // Godot's token for this extension

class Name {  // a StringName
 public:
  explicit Name(const char* utf8) { api.string_name_new_with_utf8_chars(&inside_, utf8); }
  ~Name() { api.variant_get_ptr_destructor(godot4::name_type)(&inside_); }
  Name(const Name&) = delete;
  Name& operator=(const Name&) = delete;
  void* get() { return &inside_; }

 private:
  godot4::Opaque inside_;
};

// A value of one type, without the variant around it. It shares what the variant holds.
class Typed {
 public:
  Typed(godot4::Type type, const void* variant) : type_(type) {
    api.get_variant_to_type_constructor(type)(&inside_, const_cast<void*>(variant));
  }
  ~Typed() {
    if (const godot4::Destroy destroy = api.variant_get_ptr_destructor(type_)) destroy(&inside_);
  }
  Typed(const Typed&) = delete;
  Typed& operator=(const Typed&) = delete;
  void* get() { return &inside_; }

 private:
  godot4::Type type_;
  godot4::Opaque inside_;
};

class Variant {
 public:
  Variant() { api.variant_new_nil(&inside_); }
  Variant(godot4::Type type, const void* value) {
    api.get_variant_from_type_constructor(type)(&inside_, const_cast<void*>(value));
  }
  explicit Variant(double number) : Variant(godot4::float_type, &number) {}
  explicit Variant(const std::string& utf8) {
    godot4::Opaque text;
    api.string_new_with_utf8_chars(&text, utf8.c_str());
    api.get_variant_from_type_constructor(godot4::string_type)(&inside_, &text);
    api.variant_get_ptr_destructor(godot4::string_type)(&text);
  }
  Variant(Variant&& other) noexcept : inside_(other.inside_) { api.variant_new_nil(&other.inside_); }
  Variant& operator=(Variant&& other) noexcept {
    std::swap(inside_, other.inside_);
    return *this;
  }
  ~Variant() { api.variant_destroy(&inside_); }

  static Variant empty(godot4::Type type) {
    Variant made;
    godot4::CallError error{};
    api.variant_construct(type, &made.inside_, nullptr, 0, &error);
    return made;
  }

  const void* get() const { return &inside_; }
  void* get() { return &inside_; }

 private:
  godot4::Storage inside_;  // a variant does not know its place, so its bytes can be moved
};

Variant call_method_of(const void* variant, const char* method, const Variant* argument = nullptr) {
  Variant result;
  godot4::CallError error{};
  Name name(method);
  const void* argument_place = argument ? argument->get() : nullptr;
  api.variant_call(const_cast<void*>(variant), name.get(), &argument_place, argument ? 1 : 0, result.get(), &error);
  return result;
}

template <class Number>
Number number_in(const void* variant, godot4::Type type) {
  Number number;
  api.get_variant_to_type_constructor(type)(&number, const_cast<void*>(variant));
  return number;
}
double real_in(const void* variant) { return number_in<double>(variant, godot4::float_type); }
int64_t size_of(const void* variant) {
  const Variant size = call_method_of(variant, "size");
  return number_in<int64_t>(size.get(), godot4::int_type);
}

std::string text_in(const void* variant) {
  Typed text(godot4::string_type, variant);
  std::string utf8(static_cast<size_t>(api.string_to_utf8_chars(text.get(), nullptr, 0)), '\0');
  api.string_to_utf8_chars(text.get(), utf8.data(), static_cast<int64_t>(utf8.size()));
  return utf8;
}

bool is_number(godot4::Type type) {
  return type == godot4::float_type || type == godot4::int_type || type == godot4::bool_type;
}
bool is_packed_number(godot4::Type type) {
  return type == godot4::int32s_type || type == godot4::int64s_type || type == godot4::float32s_type ||
         type == godot4::float64s_type;
}

void append_vector(const void* variant, Doubles& out) {
  float xyz[3];
  api.get_variant_to_type_constructor(godot4::vector3_type)(xyz, const_cast<void*>(variant));
  out.insert(out.end(), xyz, xyz + 3);
}

// Any list of numbers or vectors.
void numbers_of(const void* variant, Doubles& out) {
  const godot4::Type type = api.variant_get_type(variant);
  if (type == godot4::vector3s_type) {
    Typed list(type, variant);
    const int64_t size = size_of(variant);
    if (size == 0) return;
    const auto* xyz = static_cast<const float*>(api.packed_vector3_array_operator_index_const(list.get(), 0));
    out.assign(xyz, xyz + 3 * size);
  } else if (is_packed_number(type)) {
    Typed list(godot4::float64s_type, variant);
    const int64_t size = size_of(variant);
    if (size == 0) return;
    const double* numbers = api.packed_float64_array_operator_index_const(list.get(), 0);
    out.assign(numbers, numbers + size);
  } else if (type == godot4::array_type) {
    Typed list(type, variant);
    const int64_t size = size_of(variant);
    out.reserve(static_cast<size_t>(size));
    for (int64_t i = 0; i < size; ++i) {
      const void* item = api.array_operator_index_const(list.get(), i);
      const godot4::Type item_type = api.variant_get_type(item);
      if (item_type == godot4::vector3_type) {
        append_vector(item, out);
      } else {
        // other items become NaN, which the library refuses by their place
        out.push_back(is_number(item_type) ? real_in(item) : std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
}

void read_list(const void* variant, Argument& argument) {
  if (api.variant_get_type(variant) == godot4::array_type && size_of(variant) > 0) {
    Typed list(godot4::array_type, variant);
    const godot4::Type first = api.variant_get_type(api.array_operator_index_const(list.get(), 0));
    if (first == godot4::array_type || is_packed_number(first)) {
      for (int64_t i = 0, size = size_of(variant); i < size; ++i)
        numbers_of(api.array_operator_index_const(list.get(), i), argument.lists.emplace_back());
      return;
    }
  }
  numbers_of(variant, argument.list);
}

void read_dictionary(const void* variant, Argument& argument) {
  const Variant keys = call_method_of(variant, "keys");
  Typed list(godot4::array_type, keys.get());
  for (int64_t i = 0, size = size_of(keys.get()); i < size; ++i) {
    const void* key = api.array_operator_index_const(list.get(), i);
    Variant value;
    uint8_t valid = 0;
    api.variant_get_keyed(variant, key, value.get(), &valid);
    argument.named[text_in(key)] = real_in(value.get());
  }
}

struct Instance {
  void* object;  // Godot's
  std::shared_ptr<Surface> surface = std::make_shared<Surface>();
};

// The surfaces of objects that exist. A script can pass an object that was freed: its address is looked up here, never
// read.
class Registry {
 public:
  void add(const Instance& instance) {
    const std::lock_guard<std::mutex> lock(mutex_);
    surfaces_[instance.object] = instance.surface;
  }
  void remove(const Instance& instance) {
    const std::lock_guard<std::mutex> lock(mutex_);
    surfaces_.erase(instance.object);
  }
  std::shared_ptr<Surface> find(const void* object) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = surfaces_.find(object);
    return found == surfaces_.end() ? nullptr : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<const void*, std::shared_ptr<Surface>> surfaces_;
} registry;

Argument argument_of(const void* variant) {
  Argument argument;
  const godot4::Type type = api.variant_get_type(variant);
  argument.null = type == godot4::nil_type;
  if (argument.null) return argument;
  if (is_number(type)) {
    argument.number = real_in(variant);
  } else if (type == godot4::string_type) {
    argument.text = text_in(variant);
  } else if (type == godot4::vector3_type) {
    append_vector(variant, argument.list);
  } else if (type == godot4::quaternion_type) {
    float xyzw[4];
    api.get_variant_to_type_constructor(type)(xyzw, const_cast<void*>(variant));
    argument.list.assign(xyzw, xyzw + 4);
  } else if (type == godot4::object_type) {
    argument.surface = registry.find(number_in<void*>(variant, type));
  } else if (type == godot4::dictionary_type) {
    read_dictionary(variant, argument);
  } else if (type == godot4::bytes_type) {
    Typed list(type, variant);
    if (const int64_t size = size_of(variant)) {
      const uint8_t* bytes = api.packed_byte_array_operator_index_const(list.get(), 0);
      argument.bytes.assign(bytes, bytes + size);
    }
  } else {
    read_list(variant, argument);
  }
  return argument;
}

void* begin_of(void* list, godot4::Type type) {
  switch (type) {
    case godot4::bytes_type:
      return api.packed_byte_array_operator_index(list, 0);
    case godot4::int32s_type:
      return api.packed_int32_array_operator_index(list, 0);
    case godot4::float32s_type:
      return api.packed_float32_array_operator_index(list, 0);
    default:
      return api.packed_vector3_array_operator_index(list, 0);
  }
}

// A packed array with the bytes of `numbers`; `each` numbers make an element.
template <class Number>
Variant packed(godot4::Type type, const std::vector<Number>& numbers, size_t each = 1) {
  Variant made = Variant::empty(type);
  const size_t count = numbers.size() / each;
  if (count == 0) return made;
  {
    const auto size = static_cast<int64_t>(count);
    const Variant wanted(godot4::int_type, &size);
    call_method_of(made.get(), "resize", &wanted);
  }
  Typed list(type, made.get());
  made = Variant();  // the list is the only owner, so that writing does not copy
  std::memcpy(begin_of(list.get(), type), numbers.data(), count * each * sizeof(Number));
  return Variant(type, list.get());
}

Variant integers_of(const Numbers& numbers) { return packed(godot4::int32s_type, numbers); }
Variant vectors_of(const std::vector<float>& floats) { return packed(godot4::vector3s_type, floats, 3); }

void set_field(Variant& dictionary, const std::string& name, const Variant& value) {
  const Variant key(name);
  uint8_t valid = 0;
  api.variant_set_keyed(dictionary.get(), key.get(), value.get(), &valid);
}

Variant named_of(const std::map<std::string, double>& fields) {
  Variant dictionary = Variant::empty(godot4::dictionary_type);
  for (const auto& [name, number] : fields) set_field(dictionary, name, Variant(number));
  return dictionary;
}

// A list of what `each` makes of the items.
template <class Item>
Variant list_of(const std::vector<Item>& items, Variant (*each)(const Item&)) {
  Variant list = Variant::empty(godot4::array_type);
  for (const Item& item : items) {
    const Variant element = each(item);
    call_method_of(list.get(), "append", &element);
  }
  return list;
}

Variant variant_of(const Value& value) {
  const uint8_t yes = 1;
  switch (value.kind) {
    case Value::truth:
      return Variant(godot4::bool_type, &yes);
    case Value::number:
      return Variant(value.real);
    case Value::integers:
      return integers_of(value.whole);
    case Value::reals:
      return packed(godot4::float32s_type, value.floats);
    case Value::vectors:
      return vectors_of(value.floats);
    case Value::bytes:
      return packed(godot4::bytes_type, value.octets);
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

// Godot hands over a nil, which needs no end.
void give(void* result, const Variant& value) { api.variant_new_copy(result, value.get()); }

void call_method(void* method, void* instance, const void* const* values, int64_t count, void* result,
                 godot4::CallError* error) {
  error->error = 0;
  Arguments arguments;
  for (int64_t i = 0; i < count; ++i) arguments.push_back(argument_of(values[i]));
  Surface& surface = *static_cast<Instance*>(instance)->surface;
  give(result, variant_of(call(surface, *static_cast<const Entry*>(method), arguments)));
}

// { name, message, index } of the last call when it failed, empty otherwise.
void get_error(void*, void* instance, const void* const*, int64_t, void* result, godot4::CallError* error) {
  error->error = 0;
  const Surface& surface = *static_cast<Instance*>(instance)->surface;
  Variant dictionary = Variant::empty(godot4::dictionary_type);
  if (!surface.error_name.empty()) {
    set_field(dictionary, "name", Variant(surface.error_name));
    set_field(dictionary, "message", Variant(surface.error_message));
    set_field(dictionary, "index", Variant(surface.error_index));
  }
  give(result, dictionary);
}

void* make_instance(void*) {
  Name name("HfSurface"), parent("RefCounted");
  auto* instance = new Instance{api.classdb_construct_object(parent.get())};
  api.object_set_instance(instance->object, name.get(), instance);
  registry.add(*instance);
  return instance->object;
}
void free_instance(void*, void* memory) {
  const auto* instance = static_cast<Instance*>(memory);
  registry.remove(*instance);
  delete instance;
}

void register_method(const char* name, godot4::Call function, const Entry* entry) {
  Name class_name("HfSurface"), method_name(name), nothing("");
  godot4::Opaque hint;
  api.string_new_with_utf8_chars(&hint, "");
  godot4::PropertyInfo any{};
  any.name = nothing.get();
  any.class_name = nothing.get();
  any.hint_string = &hint;
  any.usage = godot4::usage_default | godot4::usage_any_variant;
  godot4::MethodInfo info{};
  info.name = method_name.get();
  info.method = const_cast<Entry*>(entry);
  info.call = function;
  info.flags = godot4::flag_normal | godot4::flag_any_arguments;
  info.has_result = 1;
  info.result = &any;
  api.classdb_register_extension_class_method(library, class_name.get(), &info);
  api.variant_get_ptr_destructor(godot4::string_type)(&hint);
}

// Vectors of three floats; a Godot that was built for double precision has others.
bool has_float_vectors() {
  const std::vector<float> zeros(6);
  const Variant two = vectors_of(zeros);
  Typed list(godot4::vector3s_type, two.get());
  const auto* first = static_cast<const char*>(api.packed_vector3_array_operator_index_const(list.get(), 0));
  const auto* second = static_cast<const char*>(api.packed_vector3_array_operator_index_const(list.get(), 1));
  return second - first == 3 * sizeof(float);
}

void say(const char* message) {
  api.print_error_with_message("hf cannot be used", message, "hf_godot_init", "gdextension.cpp", __LINE__, 0);
}

void initialize(void*, godot4::Level level) {
  if (level != godot4::scene_level) return;
  if (!has_float_vectors())
    return say("This Godot was built for double precision. HfSurface needs one with single precision.");
  Name name("HfSurface"), parent("RefCounted");
  godot4::ClassInfo info{};
  info.is_exposed = 1;
  info.create = make_instance;
  info.free = free_instance;
  api.classdb_register_extension_class3(library, name.get(), parent.get(), &info);
  for (const Entry& entry : methods()) register_method(entry.name, call_method, &entry);
  register_method("get_error", get_error, nullptr);
}

void deinitialize(void*, godot4::Level level) {
  if (level != godot4::scene_level || !has_float_vectors()) return;
  Name name("HfSurface");
  api.classdb_unregister_extension_class(library, name.get());
}

}  // namespace

#if defined(_WIN32)
#define HF_GODOT4_EXPORT __declspec(dllexport)
#else
#define HF_GODOT4_EXPORT __attribute__((visibility("default")))
#endif

extern "C" HF_GODOT4_EXPORT uint8_t hf_godot_init(godot4::FindFunction find, void* token,
                                                  godot4::Initialization* initialization) {
  library = token;
  if (const char* missing = api.load(find)) {
    if (api.print_error_with_message)
      say((std::string("Godot has no ") + missing + "; 4.3 or newer is needed").c_str());
    return 0;
  }
  *initialization = {godot4::scene_level, nullptr, initialize, deinitialize};
  return 1;
}
