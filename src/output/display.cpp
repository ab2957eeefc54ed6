#include "output/display.hpp"
