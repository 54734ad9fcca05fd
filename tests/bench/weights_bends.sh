#!/usr/bin/env bash
# weights_bends.sh HF_WEIGHTS FOLDER: twelve bends of shared models as pictures, with the weights of the file and with
# computed ones. For the eyes: a seam, a fold or a limb that collapses is a fault whatever the figures say. No shared
# model has a joint for its jaw; the frog's head stands for it.
set -eu
program=$1 folder=$2
root=$(cd "$(dirname "$0")/../.." && pwd)
data=${HF_SHARED_DATA:-$root/../shared/data}/gltf
mkdir -p "$folder"
bend() { # NAME MODEL JOINT,AXIS,DEGREES...
  local name=$1 model=$2 arguments=()
  shift 2
  for joint in "$@"; do arguments+=(--bend "$joint"); done
  "$program" "$data/$model.glb" "${arguments[@]}" --sheet "$folder/$name.png" | sed -n "s/^distance */$name $model: /p"
}
bend shoulder q_Man_Casual UpperArm.L,x,-70
bend hip q_Man_Casual UpperLeg.L,x,-80
bend knee q_Woman_Casual LowerLeg.L,x,90
bend elbow q_KnightCharacter LowerArm.L,z,90
bend hand q_Man_Casual Index2.L,x,60 Middle2.L,x,60 Ring2.L,x,60 Pinky2.L,x,60
bend jaw q_Frog Head,x,-40
bend tail q_Trex Tail1,x,30 Tail2,x,30 Tail3,x,30
bend wing q_Manta_ray TopFlipper.L,x,60 MidFlipper.L,x,60 BottomFlipper.L,x,60
bend robot q_CyberCharacter LowerArm.L,z,80 UpperLeg.L,x,-60
bend robot_legs q_Enemy_2Legs Leg2.L,x,50 Leg2.R,x,50
bend clothes q_Woman_Casual UpperArm.L,x,-60 Torso,x,30
bend leg q_Wolf FrontUpperLeg.L,x,50 FrontLowerLeg.L,x,-50
