// For loops with a constant count: software drivers take seconds to compile them unrolled.
#ifndef RILL_DONT_UNROLL_GLSL
#define RILL_DONT_UNROLL_GLSL
#extension GL_EXT_control_flow_attributes : require
#define RILL_LOOP [[dont_unroll]]
#endif
