// The part of Godot 4's C interface (GDExtension) that gdextension.cpp uses, declared anew, so that nothing of Godot is
// needed to compile. Godot hands its functions over by name; layouts and signatures are those of Godot 4.3 and newer.
// `godot --headless --dump-gdextension-interface` prints the whole interface; tests/bindings/godot4_interface.cpp holds
// these declarations against it.
#pragma once
#include <cstddef>
#include <cstdint>

namespace godot4 {

enum Type : int {  // of a variant
  nil_type = 0,
  bool_type = 1,
  int_type = 2,
  float_type = 3,
  string_type = 4,
  vector3_type = 9,
  quaternion_type = 15,
  name_type = 21,
  object_type = 24,
  dictionary_type = 27,
  array_type = 28,
  bytes_type = 29,
  int32s_type = 30,
  int64s_type = 31,
  float32s_type = 32,
  float64s_type = 33,
  vector3s_type = 36
};

// Memory for values whose insides are Godot's: at least as large and as aligned as theirs in every build.
struct alignas(8) Opaque {  // String, StringName, Array, Dictionary, any packed array
  unsigned char inside[16];
};
struct alignas(8) Storage {  // Variant: 24 bytes, 40 where numbers have double precision
  unsigned char inside[40];
};

struct CallError {
  int error;  // 0 when all is well
  int32_t argument, expected;
};

struct PropertyInfo {
  Type type;
  void *name, *class_name;  // StringName
  uint32_t hint;
  void* hint_string;  // String
  uint32_t usage;
};
constexpr uint32_t usage_any_variant = 1u << 17;  // a nil type means any variant
constexpr uint32_t usage_default = 6;

using Call = void (*)(void* method, void* instance, const void* const* arguments, int64_t count, void* result,
                      CallError* error);
struct MethodInfo {
  void* name;  // StringName
  void* method;
  Call call;
  void (*call_typed)(void*, void*, const void* const*, void*);
  uint32_t flags;
  uint8_t has_result;
  PropertyInfo* result;
  int result_metadata;
  uint32_t argument_count;
  PropertyInfo* arguments;
  int* argument_metadata;
  uint32_t default_count;
  void** defaults;
};
constexpr uint32_t flag_normal = 1, flag_any_arguments = 16;

struct ClassInfo {  // GDExtensionClassCreationInfo3
  uint8_t is_virtual, is_abstract, is_exposed, is_runtime;
  void* unused[11];  // set, get, properties (two), revert (two), validate, notification, text, references (two)
  void* (*create)(void* user_data);
  void (*free)(void* user_data, void* instance);
  void* unused_later[5];  // recreate, virtual functions (three), RID
  void* user_data;
};

enum Level : int { core_level, servers_level, scene_level, editor_level };
struct Initialization {
  Level least;
  void* user_data;
  void (*initialize)(void* user_data, Level level);
  void (*deinitialize)(void* user_data, Level level);
};

using Function = void (*)();
using FindFunction = Function (*)(const char* name);
using ToType = void (*)(void* made, void* variant);
using FromType = void (*)(void* made, void* value);
using Destroy = void (*)(void* value);

// Every function, with the name that Godot knows it by. `made` is memory without a value.
// clang-format off
#define HF_GODOT4_FUNCTIONS(f)                                                                                         \
  f(void, print_error_with_message,                                                                                    \
    (const char* description, const char* message, const char* function, const char* file, int32_t line, uint8_t show)) \
  f(Type, variant_get_type, (const void* variant))                                                                     \
  f(void, variant_new_nil, (void* made))                                                                               \
  f(void, variant_new_copy, (void* made, const void* variant))                                                         \
  f(void, variant_destroy, (void* variant))                                                                            \
  f(void, variant_construct, (Type type, void* made, const void* const* arguments, int32_t count, CallError* error))   \
  f(void, variant_call,                                                                                                \
    (void* variant, const void* method, const void* const* arguments, int64_t count, void* made, CallError* error))    \
  f(void, variant_get_keyed, (const void* variant, const void* key, void* made, uint8_t* valid))                       \
  f(void, variant_set_keyed, (void* variant, const void* key, const void* value, uint8_t* valid))                      \
  f(ToType, get_variant_to_type_constructor, (Type type))                                                              \
  f(FromType, get_variant_from_type_constructor, (Type type))                                                          \
  f(Destroy, variant_get_ptr_destructor, (Type type))                                                                  \
  f(void, string_name_new_with_utf8_chars, (void* made, const char* utf8))                                             \
  f(void, string_new_with_utf8_chars, (void* made, const char* utf8))                                                  \
  f(int64_t, string_to_utf8_chars, (const void* text, char* utf8, int64_t size))                                       \
  f(void*, array_operator_index_const, (const void* array, int64_t index))                                             \
  f(uint8_t*, packed_byte_array_operator_index, (void* array, int64_t index))                                          \
  f(int32_t*, packed_int32_array_operator_index, (void* array, int64_t index))                                         \
  f(float*, packed_float32_array_operator_index, (void* array, int64_t index))                                         \
  f(void*, packed_vector3_array_operator_index, (void* array, int64_t index))                                          \
  f(const uint8_t*, packed_byte_array_operator_index_const, (const void* array, int64_t index))                        \
  f(const double*, packed_float64_array_operator_index_const, (const void* array, int64_t index))                      \
  f(void*, packed_vector3_array_operator_index_const, (const void* array, int64_t index))                              \
  f(void, object_set_instance, (void* object, const void* class_name, void* instance))                                 \
  f(void*, classdb_construct_object, (const void* class_name))                                                         \
  f(void, classdb_register_extension_class3,                                                                           \
    (void* library, const void* class_name, const void* parent_name, const ClassInfo* info))                           \
  f(void, classdb_register_extension_class_method, (void* library, const void* class_name, const MethodInfo* info))    \
  f(void, classdb_unregister_extension_class, (void* library, const void* class_name))
// clang-format on

struct Interface {
#define HF_GODOT4_MEMBER(result, name, parameters) result(*name) parameters;
  HF_GODOT4_FUNCTIONS(HF_GODOT4_MEMBER)
#undef HF_GODOT4_MEMBER

  // The name of the first function that this Godot lacks, or null.
  const char* load(FindFunction find) {
    const char* missing = nullptr;
#define HF_GODOT4_LOAD(result, name, parameters)              \
  name = reinterpret_cast<result(*) parameters>(find(#name)); \
  if (!name && !missing) missing = #name;
    HF_GODOT4_FUNCTIONS(HF_GODOT4_LOAD)
#undef HF_GODOT4_LOAD
    return missing;
  }
};

}  // namespace godot4
