// All operators on shapes.
#pragma once
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/pattern.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/operators/tubes.h"
