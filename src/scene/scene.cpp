#include <luciole/scene.hpp>
