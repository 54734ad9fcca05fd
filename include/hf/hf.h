/* hf/hf.h - dynamic harmonic fields for games and DCC tools: everything. See base.h for the rules of all functions. */
#ifndef HF_HF_H
#define HF_HF_H

#include "hf/analysis.h"
#include "hf/base.h"
#include "hf/direction.h"
#include "hf/pose.h"
#include "hf/quads.h"
#include "hf/region.h"
#include "hf/solver.h"
#include "hf/surface.h"
#include "hf/transfer.h"

#endif
