# embed_kernels(OUTPUT NAME FILE...): a header with the text of the files, in the given order, as the
# byte array NAME, which ends with a zero. Their own #include lines are blanked, and each starts with a #line, so that a
# compiler's message names the real file and line.
function(embed_kernels output name)
    set(script ${PROJECT_SOURCE_DIR}/cmake/embed_text.cmake)
    list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE inputs)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DNAME=${name} -DROOT=${PROJECT_SOURCE_DIR}
                "-DFILES=${ARGN}" -P ${script}
        DEPENDS ${inputs} ${script}
        VERBATIM)
endfunction()
