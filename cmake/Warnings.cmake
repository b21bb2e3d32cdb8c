# Warnings for this project's own targets: link them with `gnomon_warnings` (PRIVATE).
add_library(gnomon_warnings INTERFACE)
target_compile_options(gnomon_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion # which Clang means by -Wconversion, and GCC does not
  $<$<BOOL:${GNOMON_WERROR}>:-Werror>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-overlength-strings> # pages that are embedded as texts
  # GCC 12 guesses these two from inlined standard containers, and wrongly: a warning then, no error.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overflow$<SEMICOLON>-Wno-error=free-nonheap-object>)
