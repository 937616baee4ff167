{
  lib,
  stdenv,
  fetchurl,
  cmake,
  ninja,
  boost,
  cli11,
  cmark,
  eigen,
  embree,
  expat,
  fmt,
  glm,
  libpng,
  libvpx,
  lz4,
  nlohmann_json,
  nlopt,
  openvdb,
  qhull,
  tbb,
  tomlplusplus,
  vtk,
  xz,
}:

stdenv.mkDerivation (finalAttrs: {
  pname = "espalier";
  version = "@VERSION@";

  src = fetchurl {
    url = "@URL@/espalier-${finalAttrs.version}.tar.gz";
    hash = "@SHA256SRI@";
  };

  nativeBuildInputs = [
    cmake
    ninja
  ];

  buildInputs = [
    boost
    cli11
    cmark
    eigen
    embree
    expat
    fmt
    glm
    libpng
    libvpx
    lz4
    nlohmann_json
    nlopt
    openvdb
    qhull
    tbb
    tomlplusplus
    vtk
    xz
  ];

  cmakeFlags = [
    (lib.cmakeBool "ESPALIER_TESTS" false)
    (lib.cmakeBool "ESPALIER_UNITY" true)
  ];

  meta = {
    description = "L-system simulator of plants that grow and exchange information with their environment";
    homepage = "@HOME@";
    license = lib.licenses.asl20;
    mainProgram = "espalier";
    platforms = lib.platforms.unix;
  };
})
