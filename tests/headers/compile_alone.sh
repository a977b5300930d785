#!/bin/sh
# Checks the public headers: each compiles alone, and all together with g++ and clang++, without warnings, with
# and without Vulkan prototypes, exceptions and RTTI, and with GLM, vulkan.h, volk and the macros of X11 and
# Windows. They include only the standard library and Vulkan's core, and define only macros named RILL_*.
#   compile_alone.sh INCLUDE_FOLDER SCRATCH_FOLDER [FLAG...]   flags find Vulkan's headers
set -eu
include=$1 scratch=$2
shift 2
rm -rf "$scratch"
mkdir -p "$scratch"
headers=$(cd "$include" && ls rill/*.hpp)
compilers=$(for c in g++ clang++; do command -v $c || echo "left out: $c is not installed" >&2; done)
[ -n "$headers" ] && [ -n "$compilers" ] || { echo "no headers in $include, or neither g++ nor clang++"; exit 1; }
flags="-std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I$include $*"

# job COMPILER SOURCE [FLAG...]: adds a command to the job list, which is run at the end.
job() {
  compiler=$1 source=$2
  shift 2
  echo "$compiler $flags $* $scratch/$source.cpp" >>"$scratch/jobs"
}
has() { echo "#include <$2>" | "$1" $flags -x c++ - 2>/dev/null; }
list() { for header in $headers; do echo "#include <$header>"; done; }

list >"$scratch/all.cpp"
cp "$(dirname "$0")/designated.cpp" "$scratch"
{ echo '#define GLM_FORCE_DEPTH_ZERO_TO_ONE'; echo '#define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES'; echo '#include <glm/glm.hpp>'; list; } >"$scratch/glm.cpp"
{ echo '#include <vulkan/vulkan.h>'; list; } >"$scratch/vulkan.cpp"
{ echo '#include <volk.h>'; list; } >"$scratch/volk.cpp"
for header in $headers; do
  name=$(basename "$header" .hpp)
  printf '#include <%s>\n#include <%s>\n' "$header" "$header" >"$scratch/alone_$name.cpp"  # tests the include guard
done

for header in $headers; do  # one compiler is enough to find missing includes
  name=$(basename "$header" .hpp)
  job "${compilers%%
*}" "alone_$name" -MD -MF "$scratch/$name.d"
done
for compiler in $compilers; do
  job "$compiler" all -DVK_NO_PROTOTYPES -fno-exceptions -fno-rtti
  job "$compiler" vulkan
  job "$compiler" designated
  # Macro names of X11 and Windows.
  job "$compiler" all -DNone=0L -DBool=int -DStatus=int -DSuccess=0 -DTrue=1 -DFalse=0 -DAlways=2 -DUnsorted=0 -Dnear= -Dfar= -DERROR=0 -DOPAQUE=2 -DIN= -DOUT=
  for other in glm/glm.hpp volk.h; do
    name=$(basename "${other%.*}")
    if has "$compiler" $other; then
      job "$compiler" "$name" -DVK_NO_PROTOTYPES
    else
      echo "left out: $other is not installed"
    fi
  done
done
xargs -P "$(getconf _NPROCESSORS_ONLN)" -d '\n' -n 1 sh -c 'exec $0' <"$scratch/jobs" || { echo "a header does not compile, see above"; exit 1; }

# The files that the preprocessor read for each header.
failed=0
for list in "$scratch"/*.d; do
  foreign=$(tr -s ' \\' '\n\n' <"$list" | grep -E '^/|\.hpp$' | grep -Ei \
    -e '/(glm|nlohmann|stb|GLFW|SDL[0-9]*|X11|gtest)/|/(volk|windows|json|stb_image)\.h' \
    -e '/vulkan/|/vk_[a-z_]*\.h' -e "$(dirname "$include")/" |
    grep -Ev -e '/vulkan/(vulkan_core|vk_platform)\.h$' -e '/vk_video/[a-z0-9_]*\.h$' -e "^$include/rill/[a-z0-9_]*\.hpp$" -e "^$scratch/" || true)
  if [ -n "$foreign" ]; then
    echo "$(basename "$list" .d) pulls in:" $foreign
    failed=1
  fi
done
[ "$(ls "$scratch"/*.d | wc -l)" -eq "$(echo $headers | wc -w)" ] || { echo "no list of what was read"; failed=1; }
grep -q 'vulkan_core\.h' "$scratch/device.d" || { echo "the lists do not show vulkan_core.h, which device.hpp includes"; failed=1; }

if grep -nE '^[[:space:]]*#[[:space:]]*(define|undef)' "$include"/rill/*.hpp | grep -vE '#[[:space:]]*define[[:space:]]+RILL_'; then
  echo "a macro that is not named RILL_*"
  failed=1
fi
exit $failed
