class Espalier < Formula
  desc "L-system simulator of plants that interact with their environment"
  homepage "@HOME@"
  url "@URL@/espalier-@VERSION@.tar.gz"
  sha256 "@SHA256@"
  license "Apache-2.0"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "glm" => [:build, :test]
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "boost"
  depends_on "cmark"
  depends_on "eigen"
  depends_on "embree"
  depends_on "expat"
  depends_on "fmt"
  depends_on "libpng"
  depends_on "libvpx"
  depends_on "lz4"
  depends_on "nlopt"
  depends_on "openvdb"
  depends_on "qhull"
  depends_on "tbb"
  depends_on "tomlplusplus"
  depends_on "vtk"
  depends_on "xz"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DESPALIER_UNITY=ON", "-DESPALIER_TESTS=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    assert_match version.to_s, shell_output("#{bin}/espalier --version")
    system bin/"espalier", "run", "environments/two-trees.toml", "--steps", "5", "--output", "run", "--quiet"
    assert_path_exists testpath/"run/plants.pvd"
  end
end
