// All operators on shapes.
#pragma once
#include "sdf/shape/booleans.h"
#include "sdf/shape/deform.h"
#include "sdf/shape/pattern.h"
#include "sdf/shape/place.h"
