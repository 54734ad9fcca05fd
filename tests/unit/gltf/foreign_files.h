// Small .fbx, .dae and .bvh files made by hand, with places that are known.
#ifndef HF_TESTS_GLTF_FOREIGN_FILES_H
#define HF_TESTS_GLTF_FOREIGN_FILES_H

#include <string>

namespace samples_test {

struct FbxFile {
  std::string unit = "1";                 // centimetres
  std::string axes[3] = {"0", "1", "2"};  // that point right, up and to the front
  std::string signs[3] = {"1", "1", "1"};
  std::string saved_turn = "30", last = "90";  // of the upper bone about z: as saved, and after 1 s
};

// A strip of 10 x 100 on a bone at 0 and one at 50, which a clip of a second turns about z. The corner at (20, 0, 0)
// has no bone. The two triangles of the quad have one material, the last has another. Texture coordinates: (x / 20, y / 100).
inline std::string fbx_text(const FbxFile& file = {}) {
  std::string settings;
  const char* names[] = {"Coord", "Up", "Front"};
  for (int i = 0; i < 3; ++i) {
    settings += std::string("P: \"") + names[i] + "Axis\", \"int\", \"Integer\", \"\"," + file.axes[i] + "\n";
    settings += std::string("P: \"") + names[i] + "AxisSign\", \"int\", \"Integer\", \"\"," + file.signs[i] + "\n";
  }
  return R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {
  FBXHeaderVersion: 1003
  FBXVersion: 7300
}
GlobalSettings:  {
  Version: 1000
  Properties70:  {
    P: "UnitScaleFactor", "double", "Number", "",)" +
         file.unit + "\n" + settings + R"(
    P: "TimeMode", "enum", "", "",6
  }
}
Objects:  {
  Geometry: 1, "Geometry::Strip", "Mesh" {
    Vertices: *15 { a: 0,0,0,10,0,0,10,100,0,0,100,0,20,0,0 }
    PolygonVertexIndex: *7 { a: 0,1,2,-4,1,4,-3 }
    GeometryVersion: 124
    LayerElementMaterial: 0 {
      Version: 101
      Name: ""
      MappingInformationType: "ByPolygon"
      ReferenceInformationType: "IndexToDirect"
      Materials: *2 { a: 0,1 }
    }
    LayerElementUV: 0 {
      Version: 101
      Name: ""
      MappingInformationType: "ByVertice"
      ReferenceInformationType: "Direct"
      UV: *10 { a: 0,0,0.5,0,0.5,1,0,1,1,0 }
    }
    Layer: 0 {
      Version: 100
      LayerElement:  {
        Type: "LayerElementUV"
        TypedIndex: 0
      }
      LayerElement:  {
        Type: "LayerElementMaterial"
        TypedIndex: 0
      }
    }
  }
  Model: 2, "Model::Strip", "Mesh" { Version: 232 }
  Model: 3, "Model::Lower", "LimbNode" { Version: 232 }
  Model: 4, "Model::Upper", "LimbNode" {
    Version: 232
    Properties70:  {
      P: "Lcl Translation", "Lcl Translation", "", "A",0,50,0
      P: "Lcl Rotation", "Lcl Rotation", "", "A",0,0,)" +
         file.saved_turn + R"(
    }
  }
  NodeAttribute: 5, "NodeAttribute::Lower", "LimbNode" { TypeFlags: "Skeleton" }
  NodeAttribute: 6, "NodeAttribute::Upper", "LimbNode" { TypeFlags: "Skeleton" }
  Material: 7, "Material::Red", "" {
    Version: 102
    Properties70:  {
      P: "DiffuseColor", "Color", "", "A",1,0.25,0
    }
  }
  Material: 8, "Material::Blue", "" { Version: 102 }
  Deformer: 10, "Deformer::Skin", "Skin" { Version: 101 }
  Deformer: 11, "SubDeformer::Lower", "Cluster" {
    Version: 100
    Indexes: *2 { a: 0,1 }
    Weights: *2 { a: 1,1 }
    Transform: *16 { a: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1 }
    TransformLink: *16 { a: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1 }
  }
  Deformer: 12, "SubDeformer::Upper", "Cluster" {
    Version: 100
    Indexes: *2 { a: 2,3 }
    Weights: *2 { a: 0.5,0.5 }
    Transform: *16 { a: 1,0,0,0,0,1,0,0,0,0,1,0,0,-50,0,1 }
    TransformLink: *16 { a: 1,0,0,0,0,1,0,0,0,0,1,0,0,50,0,1 }
  }
  AnimationStack: 20, "AnimStack::bend", "" { }
  AnimationLayer: 21, "AnimLayer::Base", "" { }
  AnimationCurveNode: 22, "AnimCurveNode::R", "" {
    Properties70:  {
      P: "d|Z", "Number", "", "A",0
    }
  }
  AnimationCurve: 23, "AnimCurve::", "" {
    Default: 0
    KeyVer: 4008
    KeyTime: *3 { a: 0,23093079000,46186158000 }
    KeyValueFloat: *3 { a: 0,45,)" +
         file.last + R"( }
    KeyAttrFlags: *1 { a: 24836 }
    KeyAttrDataFloat: *4 { a: 0,0,0,0 }
    KeyAttrRefCount: *1 { a: 3 }
  }
}
Connections:  {
  C: "OO",2,0
  C: "OO",3,0
  C: "OO",4,3
  C: "OO",1,2
  C: "OO",5,3
  C: "OO",6,4
  C: "OO",7,2
  C: "OO",8,2
  C: "OO",10,1
  C: "OO",11,10
  C: "OO",12,10
  C: "OO",3,11
  C: "OO",4,12
  C: "OO",21,20
  C: "OO",22,21
  C: "OP",22,4, "Lcl Rotation"
  C: "OP",23,22, "d|Z"
}
)";
}

// Hips that go 2 along x and turn about y, a knee 10 below that turns about x. A frame is half a second.
inline std::string bvh_text(const std::string& frames = "3") {
  return R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 20 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Knee
  {
    OFFSET 0 -10 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 -10 0
    }
  }
}
MOTION
Frames: )" +
         frames +
         R"(
Frame Time: 0.5
0 20 0 0 0 0 0 0 0
1 20 0 0 0 45 0 45 0
2 20 0 0 0 90 0 90 0
)";
}

// The same strip as the FBX file's, in centimetres and with z up. It bends about y.
inline std::string dae_text() {
  const std::string bend[] = {"1 0 0 0 0 1 0 0 0 0 1 50 0 0 0 1", "0 0 -1 0 0 1 0 0 1 0 0 50 0 0 0 1"};
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="strip"><mesh>
 <source id="places"><float_array id="places_a" count="12">0 0 0 10 0 0 10 0 100 0 0 100</float_array>
  <technique_common><accessor source="#places_a" count="4" stride="3"><param name="X" type="float"/>
  <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
 <triangles count="2"><input semantic="VERTEX" source="#corners" offset="0"/><p>0 1 2 0 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_controllers><controller id="skin"><skin source="#strip">
 <bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
 <source id="names"><Name_array id="names_a" count="2">Lower Upper</Name_array><technique_common>
  <accessor source="#names_a" count="2" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
 <source id="binds"><float_array id="binds_a" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
  1 0 0 0 0 1 0 0 0 0 1 -50 0 0 0 1</float_array><technique_common>
  <accessor source="#binds_a" count="2" stride="16"><param name="T" type="float4x4"/></accessor></technique_common></source>
 <source id="weights"><float_array id="weights_a" count="1">1</float_array><technique_common>
  <accessor source="#weights_a" count="1" stride="1"><param name="W" type="float"/></accessor></technique_common></source>
 <joints><input semantic="JOINT" source="#names"/><input semantic="INV_BIND_MATRIX" source="#binds"/></joints>
 <vertex_weights count="4"><input semantic="JOINT" source="#names" offset="0"/>
  <input semantic="WEIGHT" source="#weights" offset="1"/><vcount>1 1 1 1</vcount><v>0 0 0 0 1 0 1 0</v></vertex_weights>
</skin></controller></library_controllers>
<library_animations><animation id="bend">
 <source id="times"><float_array id="times_a" count="2">0 1</float_array><technique_common>
  <accessor source="#times_a" count="2" stride="1"><param name="TIME" type="float"/></accessor></technique_common></source>
 <source id="turns"><float_array id="turns_a" count="32">)" +
         bend[0] + " " + bend[1] + R"(</float_array><technique_common>
  <accessor source="#turns_a" count="2" stride="16"><param name="T" type="float4x4"/></accessor></technique_common></source>
 <source id="ways"><Name_array id="ways_a" count="2">LINEAR LINEAR</Name_array><technique_common>
  <accessor source="#ways_a" count="2" stride="1"><param name="I" type="name"/></accessor></technique_common></source>
 <sampler id="bend_s"><input semantic="INPUT" source="#times"/><input semantic="OUTPUT" source="#turns"/>
  <input semantic="INTERPOLATION" source="#ways"/></sampler>
 <channel source="#bend_s" target="Upper/transform"/></animation></library_animations>
<library_visual_scenes><visual_scene id="Scene">
 <node id="Lower" sid="Lower" type="JOINT"><matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
  <node id="Upper" sid="Upper" type="JOINT"><matrix sid="transform">)" +
         bend[0] + R"(</matrix></node></node>
 <node id="Body"><instance_controller url="#skin"><skeleton>#Lower</skeleton></instance_controller></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#Scene"/></scene></COLLADA>
)";
}

}  // namespace samples_test

#endif
