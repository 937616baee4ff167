# What systems call the library with the grids, which is opened by this name; and how a linker is told to refuse names that
# nothing defines, as those of macOS and Windows do by themselves.
if(APPLE)
  set(grid_library libespalier.${soversion}.dylib)
elseif(WIN32)
  set(grid_library libespalier.dll)
else()
  set(grid_library libespalier.so.${soversion})
  if(NOT ESPALIER_FUZZ)
    set(nothing_undefined LINKER:-z,defs)
  endif()
endif()
