// bindings/godot/src/godot4.h against what Godot prints of its own interface. godot4_interface.sh makes godot4_names.h:
// HF_GODOT_TYPE_name and HF_GODOT_SINCE_name (403: Godot 4.3) for each function, and figures of Godot's API. Compiling
// is the test.
#include <type_traits>

#include "gdextension_interface.h"
#include "godot4.h"
#include "godot4_names.h"

namespace {

// The same kind: both pointers, to functions of the same kinds or to structs of the same size where both are known; or
// both numbers of the same size and sign. Enumerations count as integers.
template <class Ours, class Theirs>
struct Same;

template <class T>
constexpr bool is_whole = std::is_integral_v<T> || std::is_enum_v<T>;

template <class Ours, class Theirs>
struct SameBehind : std::bool_constant<std::is_void_v<Theirs> || std::is_void_v<Ours> || std::is_pointer_v<Ours> ||
                                       (std::is_class_v<Ours> && std::is_class_v<Theirs>) || is_whole<Ours> ||
                                       std::is_same_v<std::remove_cv_t<Ours>, std::remove_cv_t<Theirs>>> {
  template <class T>
  static constexpr size_t size() {
    if constexpr (std::is_void_v<T>)
      return 0;
    else
      return sizeof(T);
  }
  static constexpr bool sizes = !size<Ours>() || !size<Theirs>() || size<Ours>() == size<Theirs>();
  // what is written through in our declaration may be written in Godot's
  static constexpr bool constness = std::is_const_v<Ours> || !std::is_const_v<Theirs>;
};

template <class Ours, class Theirs>
struct Same {
  static constexpr bool value = [] {
    if constexpr (std::is_pointer_v<Ours> && std::is_pointer_v<Theirs>) {
      using O = std::remove_pointer_t<Ours>;
      using T = std::remove_pointer_t<Theirs>;
      if constexpr (std::is_function_v<O> || std::is_function_v<T>)
        return Same<O, T>::value;
      else
        return SameBehind<O, T>::value && SameBehind<O, T>::sizes && SameBehind<O, T>::constness;
    } else if constexpr (std::is_void_v<Ours> || std::is_void_v<Theirs>) {
      return std::is_void_v<Ours> && std::is_void_v<Theirs>;
    } else {
      constexpr bool enumeration = std::is_enum_v<Ours> || std::is_enum_v<Theirs>;
      constexpr bool sign = enumeration || std::is_signed_v<Ours> == std::is_signed_v<Theirs>;
      constexpr bool kind = is_whole<Ours> == is_whole<Theirs> && std::is_pointer_v<Ours> == std::is_pointer_v<Theirs>;
      return sizeof(Ours) == sizeof(Theirs) && sign && kind;
    }
  }();
};
template <class R, class... P, class S, class... Q>
struct Same<R(P...), S(Q...)> {
  static constexpr bool value = [] {
    if constexpr (sizeof...(P) != sizeof...(Q))
      return false;
    else
      return Same<R, S>::value && (Same<P, Q>::value && ...);
  }();
};

#define FUNCTION(result, name, parameters)                                                    \
  static_assert(Same<decltype(godot4::Interface::name), HF_GODOT_TYPE_##name>::value, #name); \
  static_assert(HF_GODOT_SINCE_##name <= 403, #name " is newer than Godot 4.3");
HF_GODOT4_FUNCTIONS(FUNCTION)

#define SIZE(ours, theirs) \
  static_assert(sizeof(godot4::ours) == sizeof(theirs) && alignof(godot4::ours) == alignof(theirs), #ours);
#define FIELD(ours, name, theirs, their_name)                                                   \
  static_assert(offsetof(godot4::ours, name) == offsetof(theirs, their_name), #ours "." #name); \
  static_assert(Same<decltype(godot4::ours::name), decltype(theirs::their_name)>::value, #ours "." #name);
#define VALUE(ours, theirs) static_assert(int64_t(godot4::ours) == int64_t(theirs), #ours);

SIZE(CallError, GDExtensionCallError)
FIELD(CallError, error, GDExtensionCallError, error)
FIELD(CallError, argument, GDExtensionCallError, argument)
FIELD(CallError, expected, GDExtensionCallError, expected)
static_assert(GDEXTENSION_CALL_OK == 0);

SIZE(PropertyInfo, GDExtensionPropertyInfo)
FIELD(PropertyInfo, type, GDExtensionPropertyInfo, type)
FIELD(PropertyInfo, name, GDExtensionPropertyInfo, name)
FIELD(PropertyInfo, class_name, GDExtensionPropertyInfo, class_name)
FIELD(PropertyInfo, hint, GDExtensionPropertyInfo, hint)
FIELD(PropertyInfo, hint_string, GDExtensionPropertyInfo, hint_string)
FIELD(PropertyInfo, usage, GDExtensionPropertyInfo, usage)

SIZE(MethodInfo, GDExtensionClassMethodInfo)
FIELD(MethodInfo, name, GDExtensionClassMethodInfo, name)
FIELD(MethodInfo, method, GDExtensionClassMethodInfo, method_userdata)
FIELD(MethodInfo, call, GDExtensionClassMethodInfo, call_func)
FIELD(MethodInfo, call_typed, GDExtensionClassMethodInfo, ptrcall_func)
FIELD(MethodInfo, flags, GDExtensionClassMethodInfo, method_flags)
FIELD(MethodInfo, has_result, GDExtensionClassMethodInfo, has_return_value)
FIELD(MethodInfo, result, GDExtensionClassMethodInfo, return_value_info)
FIELD(MethodInfo, result_metadata, GDExtensionClassMethodInfo, return_value_metadata)
FIELD(MethodInfo, argument_count, GDExtensionClassMethodInfo, argument_count)
FIELD(MethodInfo, arguments, GDExtensionClassMethodInfo, arguments_info)
FIELD(MethodInfo, argument_metadata, GDExtensionClassMethodInfo, arguments_metadata)
FIELD(MethodInfo, default_count, GDExtensionClassMethodInfo, default_argument_count)
FIELD(MethodInfo, defaults, GDExtensionClassMethodInfo, default_arguments)

SIZE(ClassInfo, GDExtensionClassCreationInfo3)
FIELD(ClassInfo, is_virtual, GDExtensionClassCreationInfo3, is_virtual)
FIELD(ClassInfo, is_abstract, GDExtensionClassCreationInfo3, is_abstract)
FIELD(ClassInfo, is_exposed, GDExtensionClassCreationInfo3, is_exposed)
FIELD(ClassInfo, is_runtime, GDExtensionClassCreationInfo3, is_runtime)
FIELD(ClassInfo, create, GDExtensionClassCreationInfo3, create_instance_func)
FIELD(ClassInfo, free, GDExtensionClassCreationInfo3, free_instance_func)
FIELD(ClassInfo, user_data, GDExtensionClassCreationInfo3, class_userdata)
static_assert(offsetof(godot4::ClassInfo, unused) == offsetof(GDExtensionClassCreationInfo3, set_func), "unused");
static_assert(offsetof(godot4::ClassInfo, unused_later) ==
                  offsetof(GDExtensionClassCreationInfo3, recreate_instance_func),
              "unused");

SIZE(Initialization, GDExtensionInitialization)
FIELD(Initialization, least, GDExtensionInitialization, minimum_initialization_level)
FIELD(Initialization, user_data, GDExtensionInitialization, userdata)
FIELD(Initialization, initialize, GDExtensionInitialization, initialize)
FIELD(Initialization, deinitialize, GDExtensionInitialization, deinitialize)

VALUE(nil_type, GDEXTENSION_VARIANT_TYPE_NIL)
VALUE(bool_type, GDEXTENSION_VARIANT_TYPE_BOOL)
VALUE(int_type, GDEXTENSION_VARIANT_TYPE_INT)
VALUE(float_type, GDEXTENSION_VARIANT_TYPE_FLOAT)
VALUE(string_type, GDEXTENSION_VARIANT_TYPE_STRING)
VALUE(vector3_type, GDEXTENSION_VARIANT_TYPE_VECTOR3)
VALUE(quaternion_type, GDEXTENSION_VARIANT_TYPE_QUATERNION)
VALUE(name_type, GDEXTENSION_VARIANT_TYPE_STRING_NAME)
VALUE(object_type, GDEXTENSION_VARIANT_TYPE_OBJECT)
VALUE(dictionary_type, GDEXTENSION_VARIANT_TYPE_DICTIONARY)
VALUE(array_type, GDEXTENSION_VARIANT_TYPE_ARRAY)
VALUE(bytes_type, GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY)
VALUE(int32s_type, GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY)
VALUE(int64s_type, GDEXTENSION_VARIANT_TYPE_PACKED_INT64_ARRAY)
VALUE(float32s_type, GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY)
VALUE(float64s_type, GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT64_ARRAY)
VALUE(vector3s_type, GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY)
VALUE(flag_normal, GDEXTENSION_METHOD_FLAG_NORMAL)
VALUE(flag_any_arguments, GDEXTENSION_METHOD_FLAG_VARARG)
VALUE(core_level, GDEXTENSION_INITIALIZATION_CORE)
VALUE(servers_level, GDEXTENSION_INITIALIZATION_SERVERS)
VALUE(scene_level, GDEXTENSION_INITIALIZATION_SCENE)
VALUE(editor_level, GDEXTENSION_INITIALIZATION_EDITOR)
VALUE(usage_default, HF_GODOT_USAGE_DEFAULT)
VALUE(usage_any_variant, HF_GODOT_USAGE_NIL_IS_VARIANT)

// the largest of every build of Godot: single and double precision, 32 and 64 bits
static_assert(sizeof(godot4::Opaque) >= HF_GODOT_LARGEST_OPAQUE && sizeof(godot4::Storage) >= HF_GODOT_LARGEST_VARIANT,
              "memory");
static_assert(sizeof(uint8_t) == sizeof(GDExtensionBool) && sizeof(int64_t) == sizeof(GDExtensionInt), "numbers");
// Vector3 and Quaternion of the builds with single precision, which alone are used
static_assert(HF_GODOT_VECTOR3 == 3 * sizeof(float) && HF_GODOT_QUATERNION == 4 * sizeof(float), "vectors");

}  // namespace
