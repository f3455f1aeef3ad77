#pragma once

/// The version of the headers. Before 1.0 a minor release may change the
/// interface. CMake checks that it is the package's.
#define HALFSPACE_VERSION_MAJOR 0
#define HALFSPACE_VERSION_MINOR 1
#define HALFSPACE_VERSION_PATCH 0
#define HALFSPACE_VERSION "0.1.0"
