# Run by embed_kernels: writes OUTPUT, with the array NAME, from the FILES below ROOT.
set(all "")
foreach(name IN LISTS FILES)
    # Read as hexadecimal, so that semicolons and brackets mean nothing to CMake.
    file(READ ${ROOT}/${name} hex HEX)
    string(HEX "#line 1 \"${name}\"\n" line_hex)
    string(APPEND all ${line_hex} ${hex})
endforeach()
string(REGEX REPLACE "(..)" "\\1 " all "${all}") # bytes apart: matches start at a byte
string(HEX "#include \"" include_hex)
string(REGEX REPLACE "(..)" "\\1 " include_hex "${include_hex}")
string(REGEX REPLACE "${include_hex}([^0]. |0[^a] )*0a " "0a " all "${all}")
string(REGEX REPLACE "(..) " "0x\\1," bytes "${all}")
string(REGEX REPLACE "((0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,))" "\\1\n" bytes "${bytes}")
file(WRITE ${OUTPUT} "/* Generated from cl/. */\nstatic const unsigned char ${NAME}[] = {\n${bytes}\n0x00};\n")
