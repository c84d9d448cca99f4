#!/bin/bash
# The documents tell the truth: every indented command that starts with build/ or oiiotool runs as printed, the C
# programs compile and run, the reference is up to date, and every link leads somewhere.
set -eu
root=$1 build=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
ln -s "$build" "$scratch/build"
ln -s "$root/scenes" "$scratch/scenes"
cd "$scratch"

documents=("$root"/README.md "$root"/CONTRIBUTING.md "$root"/docs/*.md "$root"/docs/guide/*.md
    "$root"/docs/notes/*.md "$root"/scenes/README.md)

# Commands run one after another in one folder, so that a page can use what its earlier lines wrote.
# Pictures are rendered with few samples: their quality is not tested here.
grep -hE '^    (build/|oiiotool )' "${documents[@]}" | while read -r command; do
    echo "+ $command"
    case $command in
    "build/clshear scenes/"*"--extend "* | *--replicates* | *--list*) bash -c "$command" ;;
    "build/clshear scenes/"*) bash -c "$command --spp 8 --quiet" ;;
    *) bash -c "$command" ;;
    esac
done

# Every C program of README and of the guide to the API compiles and runs.
include="-I $root/include -I $root/cl -I $build/generated"
number=0
awk '/^```c$/ { inside = 1; n++; next } /^```/ { inside = 0 } inside { print > ("program" n ".c") }' \
    "$root/README.md" "$root/docs/guide/c-api.md"
for program in program*.c; do
    number=$((number + 1))
    echo "+ $program"
    # shellcheck disable=SC2086
    cc -std=c17 -Wall -Wextra -Werror $include "$program" -o "${program%.c}" -L "$build" -lclshear \
        -Wl,-rpath,"$build"
    "./${program%.c}" >/dev/null
done
[ "$number" -ge 4 ] || { echo "only $number programs in the documents"; exit 1; }
cp program1.c readme.c

# The reference of settings is what the program prints.
build/clshear --print-settings md | diff - "$root/docs/settings.md" ||
    { echo "docs/settings.md is out of date: clshear --print-settings md > docs/settings.md"; exit 1; }

# film.h lists every channel, of what moves too.
build/clshear scenes/wheel.gltf --width 8 --height 8 --spp 16 --shutter 0,0.25 --gain-channel --keep-patterns \
    --aov albedo --quiet --out channels.exr
channels=$(oiiotool --info -v channels.exr | sed -n 's/ *channel list: //p' | tr -d ,)
for channel in ${channels:?oiiotool names no channel}; do
    layer=${channel%%.*}
    grep -q "^ \*   .*\b${layer%%[0-9]*}\b" "$root/include/clshear/film.h" ||
        { echo "film.h does not list the channel $channel"; exit 1; }
done

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
# As a subfolder of another project: that one's settings stay, and nothing but library and program is built.
mkdir subproject
cat >subproject/CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.25)
project(host C CXX)
add_subdirectory($root clshear)
foreach(variable CMAKE_BUILD_TYPE CMAKE_C_STANDARD CMAKE_CXX_STANDARD CMAKE_C_VISIBILITY_PRESET
        CMAKE_EXPORT_COMPILE_COMMANDS BUILD_TESTING)
    if(DEFINED \${variable} AND NOT "\${\${variable}}" STREQUAL "")
        message(FATAL_ERROR "\${variable} is \${\${variable}}: clshear changed it")
    endif()
endforeach()
get_property(targets DIRECTORY $root PROPERTY BUILDSYSTEM_TARGETS)
message(STATUS "targets: \${targets}")
foreach(name example_render bench_frame test_grid)
    if(TARGET \${name})
        message(FATAL_ERROR "\${name} is built in a subproject")
    endif()
endforeach()
add_executable(user ../readme.c)
target_link_libraries(user PRIVATE clshear::clshear)
END
cmake -S subproject -B subproject/build -G Ninja >/dev/null
PKG_CONFIG_PATH=$(dirname "$(find "$PWD/installed" -name clshear.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046
cc readme.c -o packaged $(pkg-config --cflags --libs clshear)
LD_LIBRARY_PATH=$(pkg-config --variable=libdir clshear) ./packaged

# The patches that show how to add something still fit, each to a tree of its own. The sampler's is
# compiled too.
for guide in "$root"/docs/guide/adding-*.md; do
    name=$(basename "$guide" .md)
    mkdir -p "patched/$name"
    cp -r "$root/cl" "$root/host" "$root/include" "patched/$name"
    awk '/^```diff$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$guide" >"$name.diff"
    grep -q '^+++' "$name.diff" || { echo "$guide: no patch in it"; exit 1; }
    patch --quiet --directory "patched/$name" --strip 1 --fuzz 2 <"$name.diff" ||
        { echo "$guide: its patch does not fit any more"; exit 1; }
    # Kinds of lights and BSDFs take four files at most, the others two.
    files=$(grep -c '^+++' "$name.diff")
    case $name in *light | *bsdf) most=4 ;; *) most=2 ;; esac
    [ "$files" -le "$most" ] || { echo "$guide: touches $files files"; exit 1; }
done
printf '#include "clshear/device/sampler/sampler.h"\n' >sampler.c
cc -std=c17 -Wall -Wextra -Werror -fsyntax-only -I patched/adding-a-sampler/cl sampler.c

for document in "${documents[@]}"; do
    folder=$(dirname "$document")
    grep -o ']([^)]*)' "$document" | sed 's/^](//; s/)$//; s/#.*//' | while read -r link; do
        case $link in http* | '') continue ;; esac
        [ -e "$folder/$link" ] || { echo "$document: nothing at $link"; exit 1; }
    done
done
# The remarks that the guide explains are remarks of the program: the longest part without a value of each.
awk -F'`' '/^\| remark/ { inside = 1 } /^$/ { inside = 0 } inside && /^\| `/ {
    n = split($2, parts, "…"); longest = ""
    for (i = 1; i <= n; i++) { gsub(/^[ :;,]+|[ :;,]+$/, "", parts[i]); if (length(parts[i]) > length(longest)) longest = parts[i] }
    print longest }' "$root/docs/guide/first-picture.md" | while read -r remark; do
    grep -rqF -- "$remark" "$root/host" || { echo "first-picture.md: the program does not say \"$remark\""; exit 1; }
done
# CONTRIBUTING names every test.
tests=$(find "$build" -maxdepth 3 -name CTestTestfile.cmake -exec sed -n 's/^ *add_test([=[]*\([a-z0-9_]*\).*/\1/p' {} +)
for name in ${tests:?ctest has none}; do
    grep -q "[\` ]$name\`" "$root/CONTRIBUTING.md" || { echo "CONTRIBUTING.md: says nothing of test $name"; exit 1; }
done
echo "documents checked"
