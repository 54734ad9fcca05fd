/* hf/hf.h - include this to get all of hf: dynamic harmonic fields. hf/base.h has the rules of all functions. */
#ifndef HF_HF_H
#define HF_HF_H

#include "hf/analysis.h"
#include "hf/base.h"
#include "hf/direction.h"
#include "hf/pose.h"
#include "hf/quads.h"
#include "hf/region.h"
#include "hf/retarget.h"
#include "hf/skeleton.h"
#include "hf/solver.h"
#include "hf/surface.h"
#include "hf/transfer.h"
#include "hf/weights.h"

#endif
