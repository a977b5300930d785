# shellcheck shell=bash
# Shared by apps/demo.sh and tests/run.sh: the list of packages, their installation, the build. Source it from the project root.

# Columns: section, Debian and Ubuntu package, description for other systems. Packages of "test?" are optional.
packages='
build g++                     a C++20 compiler (GCC 12 or newer)
build cmake                   CMake 3.25 or newer
build ninja-build             Ninja
build libvulkan-dev           Vulkan headers 1.3.239 or newer
build glslang-tools           glslang (glslangValidator)
build spirv-tools             SPIRV-Tools (spirv-opt, spirv-val, and its library)
build spirv-cross             SPIRV-Cross (reflects the bindings of shaders)
build spirv-headers           SPIR-V headers
build libglm-dev              GLM
build nlohmann-json3-dev      nlohmann/json 3.11 or newer
build libcli11-dev            CLI11
build libstb-dev              stb (stb_image.h, stb_image_write.h)
build libtinyobjloader-dev    tinyobjloader 2.0 (tiny_obj_loader.h)
build libtinygltf-dev         tinygltf 2.7 or newer (tiny_gltf.h)
build libopenexr-dev          OpenEXR 3.1 or newer (rill-capture --exr; built without it where it is missing)
build libglfw3-dev            GLFW 3.3 or newer
build libimgui-dev            Dear ImGui 1.86 or newer
run   libvulkan1              the Vulkan loader
run   fonts-dejavu-core       DejaVu Sans (typeface of the viewer)
run   mesa-vulkan-drivers     a Vulkan 1.3 driver (Mesa: lavapipe needs no GPU)
test  git                     git (the files that the checks of format look at)
test  doxygen                 Doxygen 1.9 or newer (the pages of the public headers)
test  clang                   clang (also compiles the public headers)
test  libgtest-dev            GoogleTest
test  libvulkan-volk-dev      volk (used by a test host)
test  libbullet-dev           Bullet 3 (used by a test host)
test  pkgconf                 pkg-config (builds a test host)
test  glslang-dev             glslang (library, for shader reload in development builds and a test)
test  binutils                binutils (nm)
test  ffmpeg                  ffmpeg with libx264, and ffprobe (the videos of rill-capture)
test  gnuplot-nox             gnuplot (the diagrams of rill-bench)
test  vulkan-validationlayers the Khronos validation layer
test  xvfb                    Xvfb (a display for windows of the viewer)
test  xauth                   xauth (which xvfb-run needs)
test? clang-format-14         clang-format 14 (later ones break lines elsewhere)
test? clang-tidy-14           clang-tidy 14
test? chromium-common         SwiftShader (libvk_swiftshader.so with its vk_swiftshader_icd.json)
'

# phase TEXT...: prints TEXT with the seconds since the script started.
phase() { printf '\n[%4d s] %s\n' "$SECONDS" "$*"; }

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# in_sections SECTION...: prints the packages of these sections.
in_sections() {
  local section name upstream
  while read -r section name upstream; do
    [[ " $* " == *" $section "* ]] && printf '%s %s %s\n' "$section" "$name" "$upstream"
  done <<<"$packages"
  return 0
}

is_installed() { [[ $(dpkg-query -W -f='${db:Status-Abbrev}' "$1" 2>/dev/null) == ii* ]]; }
is_known() { [[ $(LC_ALL=C apt-cache policy "$1" 2>/dev/null) =~ Candidate:\ [^\(] ]]; }

as_root() {
  if [ "$(id -u)" = 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

# logged COMMAND...: runs COMMAND and shows its output only if it fails.
logged() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 </dev/null || status=$?
  [ $status = 0 ] || tail -n 30 "$log" >&2
  rm -f "$log"
  return $status
}

# install_packages SECTION...: installs missing packages. Does not use apt or the network if there are none.
install_packages() {
  local section name upstream missing=() optional=() lists=/var/lib/apt/lists
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    {
      echo "Automatic installation supports only Debian and Ubuntu. Install these packages, then run again with --no-install:"
      in_sections "$@" | while read -r section name upstream; do printf '  %s\n' "$upstream"; done
    } >&2
    exit 1
  fi
  while read -r section name upstream; do
    if is_installed "$name"; then
      continue
    elif [[ $section != *\? ]]; then
      missing+=("$name")
    else
      optional+=("$name")
    fi
  done < <(in_sections "$@")
  # Optional packages that are not in the package lists do not justify fetching the lists again.
  if [ ${#missing[@]} = 0 ] && compgen -G "$lists/*_Packages*" >/dev/null; then
    local known=()
    for name in "${optional[@]}"; do
      if is_known "$name"; then known+=("$name"); fi
    done
    optional=("${known[@]}")
  fi
  local all=("${missing[@]}" "${optional[@]}")
  if [ ${#all[@]} = 0 ]; then
    phase "All packages are installed"
    return
  fi
  if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
    fail "Installing packages requires root, and sudo was not found. Run as root: apt-get install --no-install-recommends ${all[*]}"
  fi

  phase "Installing ${all[*]}"
  logged as_root apt-get -o DPkg::Lock::Timeout=300 update || echo "apt-get update failed; using the existing package lists" >&2
  for name in "${optional[@]}"; do
    if is_known "$name"; then missing+=("$name"); fi
  done
  if [ ${#missing[@]} = 0 ]; then return; fi
  logged as_root apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends "${missing[@]}" ||
    fail "apt-get install failed (requires Debian 12, Ubuntu 24.04 or newer)"
}

# build_release TESTS TARGET: builds TARGET in build/release; TESTS is ON or OFF.
build_release() {
  phase "Building $2 into build/release"
  logged cmake --preset release -DRILL_BUILD_TESTS="$1"
  cmake --build --preset release --parallel "$(nproc)" --target "$2"
}
