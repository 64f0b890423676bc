// Ceres' matchers for manifolds, whose header has no guard: sources are compiled several at a time.
#pragma once

#include <ceres/manifold_test_utils.h>
