/* hf/hf.h - dynamic harmonic fields for games and DCC tools: everything. See base.h for the conventions. */
#ifndef HF_HF_H
#define HF_HF_H

#include "hf/analysis.h"
#include "hf/base.h"
#include "hf/deform.h"
#include "hf/detail.h"
#include "hf/direction.h"
#include "hf/factor.h"
#include "hf/field.h"
#include "hf/mesh.h"
#include "hf/quads.h"
#include "hf/transfer.h"

#endif
