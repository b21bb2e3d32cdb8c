# Warnings for this project's own targets: link them with `gnomon_warnings` (PRIVATE).
add_library(gnomon_warnings INTERFACE)
target_compile_options(gnomon_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  # GCC 12 guesses these two from inlined standard containers, and wrongly: a warning then, no error.
  $<$<BOOL:${GNOMON_WERROR}>:-Werror$<SEMICOLON>-Wno-error=stringop-overflow$<SEMICOLON>-Wno-error=free-nonheap-object>)
