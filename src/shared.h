// Lets one file be read by both compilers: `#include "shared.h"`, then SHARED_BEGIN ... SHARED_END around declarations
// in the common subset of C++ and GLSL. In C++ they land in luciole::shared.
#ifndef LUCIOLE_SHARED_H
#define LUCIOLE_SHARED_H
#ifdef __cplusplus
#include <luciole/math.hpp>
#define SHARED_BEGIN                \
    namespace luciole::shared {     \
    using namespace glm;            \
    using uint = uint32_t;
#define SHARED_END }
#define SHARED_FN inline
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#endif
#endif
