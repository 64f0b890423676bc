#include "octafield/volume/lattice_cells.hpp"

#include <gtest/gtest.h>

TEST(Lattice, Placeholder) {}
