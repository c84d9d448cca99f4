#!/bin/bash
# The documents tell the truth: every indented command that starts with build/ runs as printed, the C
# program in the README compiles and runs, and every link leads somewhere.
set -eu
root=$1 build=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
ln -s "$build" "$scratch/build"
ln -s "$root/scenes" "$scratch/scenes"
cd "$scratch"

grep -h '^    build/' "$root"/README.md "$root"/docs/*.md "$root"/docs/guide/*.md \
    "$root"/scenes/README.md | while read -r command; do
    echo "+ $command"
    # A picture of documentation size is not what is tested here.
    case $command in *bench* | *points* | *slice* | *--list* | *"--extend "*) bash -c "$command" ;; *) bash -c "$command --spp 8 --quiet" ;; esac
done

awk '/^```c$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$root/README.md" >readme.c
cc -std=c17 -Wall -Wextra -Werror -I "$root/include" readme.c -o readme -L "$build" -lclshear \
    -Wl,-rpath,"$build"
./readme

# Installed anywhere: the program starts, and others find the library by CMake and by pkg-config.
cmake --install "$build" --prefix "$PWD/installed" >/dev/null
./installed/bin/clshear --version
cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.20)
project(user C)
find_package(clshear REQUIRED)
add_executable(user readme.c)
target_link_libraries(user PRIVATE clshear::clshear)
END
cmake -S . -B user -DCMAKE_PREFIX_PATH="$PWD/installed" >/dev/null
cmake --build user >/dev/null
./user/user
PKG_CONFIG_PATH=$(dirname "$(find "$PWD/installed" -name clshear.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046
cc readme.c -o packaged $(pkg-config --cflags --libs clshear)
LD_LIBRARY_PATH=$(pkg-config --variable=libdir clshear) ./packaged

# The patch that shows how to add a sampler still fits.
mkdir -p patched/cl/clshear
cp -r "$root/cl/clshear/device" patched/cl/clshear
awk '/^```diff$/ { inside = 1; next } /^```/ { inside = 0 } inside' \
    "$root/docs/guide/adding-a-sampler.md" | patch --directory patched --strip 1 --fuzz 0
printf '#include "clshear/device/sampler/sampler.h"\n' >sampler.c
cc -std=c17 -Wall -Wextra -Werror -fsyntax-only -I patched/cl sampler.c

for document in "$root"/README.md "$root"/docs/*.md "$root"/docs/guide/*.md "$root"/scenes/README.md; do
    folder=$(dirname "$document")
    grep -o '](\([^)#]*\))' "$document" | tr -d '()]' | while read -r link; do
        case $link in http*) continue ;; esac
        [ -e "$folder/$link" ] || { echo "$document: nothing at $link"; exit 1; }
    done
done
echo "documents checked"
