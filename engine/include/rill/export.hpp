#pragma once
// RILL_API marks what the shared library shows; all else in it is hidden.
#if defined(__GNUC__)
#define RILL_API __attribute__((visibility("default")))
#else
#define RILL_API
#endif
