#include "halfspace/scene_file.hpp"
