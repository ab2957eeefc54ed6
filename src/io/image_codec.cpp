#include <luciole/output.hpp>
