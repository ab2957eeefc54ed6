#include <luciole/reference.hpp>
