# GNOMON_SANITIZE builds everything under a sanitizer of GCC.
#   address  AddressSanitizer, UndefinedBehaviorSanitizer and the assertions of libstdc++
#   thread   ThreadSanitizer
set(GNOMON_SANITIZE "" CACHE STRING "Sanitizer: address, thread or none (empty)")
set(gnomon_sanitize_address -fsanitize=address,undefined)
set(gnomon_sanitize_thread -fsanitize=thread)
if(GNOMON_SANITIZE)
  if(NOT DEFINED gnomon_sanitize_${GNOMON_SANITIZE})
    message(FATAL_ERROR "GNOMON_SANITIZE=${GNOMON_SANITIZE} is not known. Allowed: address, thread, or nothing.")
  endif()
  add_compile_options(${gnomon_sanitize_${GNOMON_SANITIZE}} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(${gnomon_sanitize_${GNOMON_SANITIZE}})
  if(GNOMON_SANITIZE STREQUAL "address")
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
  endif()
endif()
