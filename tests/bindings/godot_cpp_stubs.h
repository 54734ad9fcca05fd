// Stand-ins for the part of godot-cpp that bindings/godot/src/gdextension.cpp uses, with the signatures of its public
// headers: enough to compile it and to have templates and overloads checked; nothing runs.
#pragma once
#include <cstdint>
#include <initializer_list>

using GDExtensionBool = uint8_t;
using GDExtensionInterfaceGetProcAddress = void (*(*)(const char*))();
using GDExtensionClassLibraryPtr = void*;
struct GDExtensionInitialization;
#define GDE_EXPORT __attribute__((visibility("default")))

namespace godot {

class Object;
class Array;
class Dictionary;
class Variant;

class CharString {
 public:
  const char* get_data() const;
};
class StringName {
 public:
  StringName(const char*);
};
class String {
 public:
  String();
  String(const char*);
  String(const StringName&);  // as godot-cpp: String(variant) is ambiguous, String s = variant is not
  CharString utf8() const;
  static String utf8(const char*, int64_t length = -1);
};
struct Vector3 {
  Vector3();
  Vector3(float x, float y, float z);
  float x, y, z;
};

template <class Element>
class Packed {
 public:
  Packed();
  Packed(const Array&);
  int64_t size() const;
  int64_t resize(int64_t);
  void set(int64_t, const Element&);
  const Element* ptr() const;
};
using PackedByteArray = Packed<uint8_t>;
using PackedInt32Array = Packed<int32_t>;
using PackedFloat32Array = Packed<float>;
struct Quaternion {
  float x, y, z, w;
};
using PackedVector3Array = Packed<Vector3>;

class Variant {
 public:
  enum Type { NIL, BOOL, INT, FLOAT, STRING, VECTOR3, QUATERNION, OBJECT, DICTIONARY, ARRAY, PACKED_BYTE_ARRAY, PACKED_INT32_ARRAY };
  Variant();
  Variant(bool);
  Variant(int64_t);
  Variant(int32_t);
  Variant(uint32_t);
  Variant(double);
  Variant(float);
  Variant(const char*);
  Variant(const String&);
  Variant(const Vector3&);
  Variant(const Object*);
  Variant(const Dictionary&);
  Variant(const Array&);
  template <class Element>
  Variant(const Packed<Element>&);
  Type get_type() const;
  operator bool() const;
  operator int64_t() const;
  operator int32_t() const;
  operator uint32_t() const;
  operator double() const;
  operator float() const;
  operator String() const;
  operator StringName() const;
  operator Vector3() const;
  operator Quaternion() const;
  operator Object*() const;
  operator Dictionary() const;
  operator Array() const;
  operator PackedByteArray() const;
  operator PackedInt32Array() const;
};

class Array {
 public:
  Array();
  int64_t size() const;
  void push_back(const Variant&);
  const Variant& operator[](int64_t) const;
  Variant& operator[](int64_t);
};
class Dictionary {
 public:
  Dictionary();
  Array keys() const;
  const Variant& operator[](const Variant&) const;
  Variant& operator[](const Variant&);
};

class Object {
 public:
  template <class T>
  static T* cast_to(Object*);
};
class RefCounted : public Object {};
#define GDCLASS(name, base) \
 private:                   \
  void operator=(const name&);

struct MethodDefinition {};
template <class... Names>
MethodDefinition D_METHOD(const char*, const Names*...);
enum ModuleInitializationLevel { MODULE_INITIALIZATION_LEVEL_CORE, MODULE_INITIALIZATION_LEVEL_SCENE };
class ClassDB {
 public:
  template <class Method>
  static void bind_method(MethodDefinition, Method);
  template <class Class>
  static void register_class();
};
class GDExtensionBinding {
 public:
  using Callback = void (*)(ModuleInitializationLevel);
  class InitObject {
   public:
    InitObject(GDExtensionInterfaceGetProcAddress, GDExtensionClassLibraryPtr, GDExtensionInitialization*);
    void register_initializer(Callback) const;
    void register_terminator(Callback) const;
    void set_minimum_library_initialization_level(ModuleInitializationLevel) const;
    GDExtensionBool init() const;
  };
};

}  // namespace godot
