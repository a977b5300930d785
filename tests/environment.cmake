# Read by ctest: what all tests have in their environment. Programs that they start leave the user's cache folder alone.
set(ENV{RILL_PIPELINE_CACHE} off)
