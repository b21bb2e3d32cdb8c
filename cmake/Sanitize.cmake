# GNOMON_SANITIZE builds everything under a sanitizer; `./check asan` and `./check tsan` set it.
#   address  AddressSanitizer, UndefinedBehaviorSanitizer and the assertions of libstdc++
#   thread   ThreadSanitizer
# GNOMON_SANITIZER_ENVIRONMENT is then what tests need in their environment: suppressions, which name third parties' frames, and
# that no library is unloaded, which would take its frames' names and all pointers to its blocks with it.
set(GNOMON_SANITIZE "" CACHE STRING "Sanitizer: address, thread or none (empty)")
set(gnomon_sanitize_address -fsanitize=address,undefined)
set(gnomon_sanitize_thread -fsanitize=thread)
if(GNOMON_SANITIZE)
  if(NOT DEFINED gnomon_sanitize_${GNOMON_SANITIZE})
    message(FATAL_ERROR "GNOMON_SANITIZE=${GNOMON_SANITIZE} is not known. Allowed: address, thread, or nothing.")
  endif()
  if(GNOMON_SANITIZE STREQUAL "address")
    add_library(gnomon_kept_modules SHARED EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/tests/sanitize/kept_modules.cpp)
    set_target_properties(gnomon_kept_modules PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/sanitize)
  endif()
  add_compile_options(${gnomon_sanitize_${GNOMON_SANITIZE}} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(${gnomon_sanitize_${GNOMON_SANITIZE}})
  set(suppressions ${PROJECT_SOURCE_DIR}/tests/sanitize)
  if(GNOMON_SANITIZE STREQUAL "address")
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
    set(GNOMON_SANITIZER_ENVIRONMENT "LD_PRELOAD=${PROJECT_BINARY_DIR}/sanitize/libgnomon_kept_modules.so"
      "LSAN_OPTIONS=suppressions=${suppressions}/leaks.txt:print_suppressions=0;UBSAN_OPTIONS=print_stacktrace=1")
  else()
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      message(FATAL_ERROR "GNOMON_SANITIZE=thread needs Clang, which can leave oneTBB's headers unwatched. Set CXX=clang++.")
    endif()
    add_compile_options(-fsanitize-ignorelist=${suppressions}/uninstrumented.txt)
    include_directories(BEFORE ${suppressions}) # headers of tbb/ that say what oneTBB's library orders
    set(GNOMON_SANITIZER_ENVIRONMENT
      "TSAN_OPTIONS=suppressions=${suppressions}/threads.txt:ignore_noninstrumented_modules=1:halt_on_error=0")
  endif()
endif()
