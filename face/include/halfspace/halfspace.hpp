#pragma once

/// The library in one header (docs/library.md): solids, meshes, pictures.
#include "halfspace/cut_display.hpp"
#include "halfspace/display.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/moving_display.hpp"
#include "halfspace/scalar_display.hpp"
#include "halfspace/solid.hpp"
#include "halfspace/version.hpp"
