#!/bin/bash
# One more line in the table of settings, in a copy of the tree: it is a flag, a line of settings
# files, metadata, part of the recipe, in the help and the reference; and the library with it runs
# programs that were built without it.
set -eu
root=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"

# tree NAME: a copy of the sources, configured without optimisation and with what abidiff reads.
tree() {
    mkdir "$1"
    tar -C "$root" --exclude='./build*' --exclude=./.git -cf - . | tar -C "$1" -xf -
}
build() {
    cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_TESTING=OFF \
        -DCLSHEAR_BUILD_BENCH=OFF -DCLSHEAR_BUILD_EXAMPLES=OFF >/dev/null
    cmake --build "$1/build" --target "$2" >"$1.log" || { tail -n 30 "$1.log"; exit 1; }
}
tree before
tree after
sed -i 's|^    /\* Device \*/ |    X(MADE_UP, 999, "made-up", "invented", NUMBER, 1, 1, "2.5", 0, 10, none, RECIPE, "X", "nothing obeys this") \\\n&|' \
    after/include/clshear/setting_list.h
[ "$(diff before/include/clshear/setting_list.h after/include/clshear/setting_list.h | grep -c '^[<>]')" -eq 1 ] ||
    { echo "the line was not added"; exit 1; }
build before clshear
build after clshear_program
program=after/build/clshear

expect() { # CODE WORDS COMMAND...
    local code=$1 words=$2 got=0
    shift 2
    output=$("$@" 2>&1 </dev/null) || got=$?
    [ "$got" -eq "$code" ] || { echo "$*: exit $got, not $code: $output"; exit 1; }
    case $output in *"$words"*) ;; *) echo "$*: no \"$words\" in: $output"; exit 1 ;; esac
}
cornell=$root/scenes/cornell.obj
small="--width 16 --height 16 --spp 4 --quiet"
# shellcheck disable=SC2086
{
    expect 0 "--made-up X" $program --help
    expect 0 "(2.5)" $program --help
    expect 0 "made-up" $program --print-settings md
    expect 0 'made\-up' $program --print-settings man
    expect 2 "--made-up 11: must be a number, 0 to 10" $program "$cornell" $small --made-up 11
    expect 0 "" $program "$cornell" $small --invented 3 --extendable --out flag.exr
    expect 0 'clshear.madeUp: 3' oiiotool --info -v flag.exr
    expect 2 "another made-up" $program "$cornell" $small --spp 8 --extend flag.exr --out more.exr
    echo "made-up 4" >mine.flags
    expect 0 "" $program "$cornell" $small --settings mine.flags --out file.exr
    expect 0 'clshear.madeUp: 4' oiiotool --info -v file.exr
}

# A program built with the header before runs with the library after, and can name the setting.
cat >user.c <<'END'
#include <clshear/clshear.h>
#include <stdio.h>
int main(int argc, char **argv)
{
    clshear_settings *settings = NULL;
    clshear_setting found = (clshear_setting)0;
    double value = 0.0;
    clshear_setting_info info = {.struct_size = sizeof info};
    size_t count = 0;
    if (clshear_settings_create(&settings) != CLSHEAR_OK) return 1;
    if (clshear_settings_set_integer(settings, CLSHEAR_PACKET, 8) != CLSHEAR_OK) return 2;
    while (clshear_setting_describe(count, &info)) count++;
    if (argc > 1 && clshear_setting_find(argv[1], &found) == CLSHEAR_OK &&
        clshear_settings_set_number(settings, found, 7.0) == CLSHEAR_OK &&
        clshear_settings_get_number(settings, found, &value) == CLSHEAR_OK)
        printf("%s %g of %zu\n", argv[1], value, count);
    else
        printf("%s\n", clshear_message());
    clshear_settings_free(settings);
    return 0;
}
END
cc -std=c17 -Wall -Wextra -Werror -I before/include -I before/build/generated user.c -o user \
    -L before/build -lclshear
LD_LIBRARY_PATH=before/build expect 0 "unknown setting made-up" ./user made-up
LD_LIBRARY_PATH=after/build expect 0 "made-up 7 of" ./user made-up

# The binary interface: abidiff's status has bit 8 (3) for an incompatible change.
if command -v abidiff >/dev/null; then
    status=0
    abidiff before/build/libclshear.so after/build/libclshear.so >abi.txt || status=$?
    [ $((status & 1)) -eq 0 ] && [ $((status & 8)) -eq 0 ] || { cat abi.txt; exit 1; }
    echo "abidiff: status $status, no incompatible change"
else
    echo "no abidiff here: the binary interface is not compared"
fi
echo "one line, seen everywhere"
