# Copyright Spack Project Developers. See COPYRIGHT file for details.
#
# SPDX-License-Identifier: (Apache-2.0 OR MIT)

from spack.package import *


class Espalier(CMakePackage):
    """Espalier simulates the growth of plants with L-systems that exchange information with their environment."""

    homepage = "@HOME@"
    url = "@URL@/espalier-@VERSION@.tar.gz"

    license("Apache-2.0")

    version("@VERSION@", sha256="@SHA256@")

    variant("look", default=True, description="Read, draw and export recorded runs (needs VTK)")
    variant("python", default=False, description="Build the Python module")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("cli11", type="build")
    depends_on("nlohmann-json", type="build")
    depends_on("eigen")
    depends_on("embree@3:")
    depends_on("expat")
    depends_on("fmt")
    depends_on("glm")
    depends_on("intel-oneapi-tbb")
    depends_on("libpng")
    depends_on("lz4")
    depends_on("openvdb")
    depends_on("tomlplusplus")
    with when("+look"):
        depends_on("boost@1.74:")
        depends_on("cmark")
        depends_on("libvpx")
        depends_on("nlopt")
        depends_on("qhull")
        depends_on("vtk@9.1:")
        depends_on("xz")
    with when("+python"):
        extends("python@3.11:")
        depends_on("py-numpy", type=("build", "run"))
        depends_on("py-pybind11@2.10:", type="build")

    generator("ninja")
    conflicts("%gcc@:11", msg="C++20 needs g++ 12")

    def cmake_args(self):
        return [
            self.define("ESPALIER_TESTS", False),
            self.define("ESPALIER_UNITY", True),
            self.define_from_variant("ESPALIER_LOOK", "look"),
            self.define_from_variant("ESPALIER_PYTHON", "python"),
        ]
