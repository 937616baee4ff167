// The arrays of VTK's XML files, as far as they are believed.
#include "archive/vtk_xml.h"

#include "base/base64.h"
#include "catch.h"
#include "temporary_folder.h"

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <cstdint>
#include <string>
#include <vector>

using namespace espalier;
using namespace espalier::archive;

namespace {

std::string bytes_of(const std::vector<std::uint64_t>& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint64_t)};
}

/// A file with an array of zeros in one block. `claimed`: how many bytes it says that there are.
std::string file_of_zeros(std::size_t bytes, std::uint64_t claimed) {
    const std::string zeros(bytes, '\0');
    vtkNew<vtkZLibDataCompressor> compressor;
    std::vector<unsigned char> packed(compressor->GetMaximumCompressionSpace(bytes));
    packed.resize(compressor->Compress(reinterpret_cast<const unsigned char*>(zeros.data()), bytes, packed.data(),
                                       packed.size()));
    const std::string block(reinterpret_cast<const char*>(packed.data()), packed.size());
    return "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
           "compressor=\"vtkZLibDataCompressor\"><PolyData><Piece><DataArray type=\"UInt8\" Name=\"zeros\" "
           "format=\"binary\">" +
           base64(bytes_of({1, claimed, 0, block.size()})) + base64(block) +
           "</DataArray></Piece></PolyData></VTKFile>";
}

std::size_t read_zeros(const TemporaryFolder& folder, const std::string& text) {
    const VtkXmlFile file(folder.write("zeros.vtp", text), "PolyData");
    return file.array(*VtkXmlFile::find(file.piece(), "zeros")).bytes.size();
}

}  // namespace

TEST_CASE("a block unpacks to 16 MiB, and to no byte more", "[reading]") {
    const TemporaryFolder folder;
    constexpr std::size_t most = std::size_t{16} << 20;
    CHECK(read_zeros(folder, file_of_zeros(1000, 1000)) == 1000);
    CHECK(read_zeros(folder, file_of_zeros(most, most)) == most);
    CHECK_THROWS_WITH(read_zeros(folder, file_of_zeros(most + 1, most + 1)), Catch::Contains("'zeros' are damaged"));
    // Nor more or less than it holds.
    CHECK_THROWS_WITH(read_zeros(folder, file_of_zeros(1000, 1001)), Catch::Contains("'zeros' are damaged"));
    CHECK_THROWS_WITH(read_zeros(folder, file_of_zeros(1000, 999)), Catch::Contains("'zeros' are damaged"));
}
