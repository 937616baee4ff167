// What VTK's own readers make of the files that are written without VTK's writers.
#include "timeline/files/vtk_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "small_disk.h"
#include "temporary_folder.h"

#include <tbb/global_control.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <array>
#include <cstring>
#include <numeric>
#include <random>

using namespace espalier;
using namespace espalier::timeline;

namespace {

/// Into a file that has begun: points without cells, with these arrays on them.
void fill_points(VtkFile& file, const std::filesystem::path& path, const std::vector<float>& points,
                 const std::vector<DataArray>& arrays, const std::vector<std::string>& texts = {}) {
    file.open("PolyData");
    file.open("FieldData");
    file.add_time(2.5, 7);
    file.add_texts("a <b> & \"c\"", texts);
    file.close();
    file.open("Piece", "NumberOfPoints=\"" + std::to_string(points.size() / 3) + "\"");
    file.open("PointData");
    for (const DataArray& array : arrays) file.add(array);
    file.close();
    file.open("Points");
    file.add(data_array<float>("points", points, 3));
    file.write(path);
}

void write_points(const std::filesystem::path& path, std::size_t count, const std::vector<DataArray>& arrays,
                  const std::vector<std::string>& texts = {}) {
    VtkFile file;
    file.begin("PolyData");
    fill_points(file, path, std::vector<float>(3 * count, 0.5f), arrays, texts);
}

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& path) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    REQUIRE(reader->GetErrorCode() == 0);
    return reader->GetOutput();
}

/// The bytes of an array of points as VTK read them.
std::string bytes_read(vtkPolyData* data, const char* name) {
    vtkDataArray* array = data->GetPointData()->GetArray(name);
    REQUIRE(array);
    const auto size = std::size_t(array->GetDataTypeSize()) * std::size_t(array->GetNumberOfValues());
    return {static_cast<const char*>(array->GetVoidPointer(0)), size};
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// Values with long runs, short runs and noise in turns.
template <class T>
std::vector<T> mixed_values(std::size_t count, std::mt19937& random) {
    std::vector<T> values;
    while (values.size() < count) {
        const std::size_t run = std::array<std::size_t, 3>{1, 3, 5000}[random() % 3];
        for (std::size_t i = 0; i < run && values.size() < count; ++i) {
            values.push_back(i == 0 || random() % 1000 == 0 ? static_cast<T>(random()) : values.back());
        }
    }
    return values;
}

template <class T>
void check_plain_and_runs(std::size_t count, std::mt19937& random) {
    INFO(vtk_type<T>() << " x " << count);
    const std::vector<T> values = mixed_values<T>(count, random);
    std::vector<T> of_runs;
    std::vector<std::uint32_t> ends;
    for (std::size_t i = 0; i < count; ++i) {
        if (i == 0 || values[i] != values[i - 1] || random() % 7 == 0) {
            of_runs.push_back(values[i]);
            ends.push_back(0);
        }
        ends.back() = static_cast<std::uint32_t>(i + 1);
    }
    DataArray runs = data_array<T>("runs", std::span<const T>(of_runs));
    runs.tuples = count;
    runs.ends = ends;
    const TemporaryFolder folder;
    write_points(folder.path() / "a.vtp", count, {data_array<T>("plain", std::span<const T>(values)), runs});
    const auto data = read(folder.path() / "a.vtp");
    REQUIRE(data->GetNumberOfPoints() == vtkIdType(count));
    CHECK((bytes_read(data, "plain") == bytes_of(values)));
    CHECK((bytes_read(data, "runs") == bytes_of(values)));
}

}  // namespace

TEST_CASE("arrays of any type and length read back as they were, whether given as values or as runs", "[timeline]") {
    std::mt19937 random(1);
    // One value less and more than whole blocks of 256 KiB, of every width.
    for (const std::size_t count :
         {1, 2, 3, 32767, 32768, 32769, 65536, 65537, 131071, 131073, 262143, 262144, 262145, 600000}) {
        check_plain_and_runs<std::uint8_t>(count, random);
        check_plain_and_runs<std::uint16_t>(count, random);
        check_plain_and_runs<float>(count, random);
        check_plain_and_runs<std::uint64_t>(count, random);
    }
}

TEST_CASE("arrays of several components read back", "[timeline]") {
    std::mt19937 random(4);
    const auto check = [&](auto value, std::size_t count, int components) {
        INFO(count << " x " << components);
        const std::vector<decltype(value)> values =
            mixed_values<decltype(value)>(count * std::size_t(components), random);
        const TemporaryFolder folder;
        write_points(folder.path() / "a.vtp", count,
                     {data_array<decltype(value)>("values", std::span<const decltype(value)>(values), components)});
        CHECK((bytes_read(read(folder.path() / "a.vtp"), "values") == bytes_of(values)));
    };
    for (const std::size_t count : {1, 2, 5, 21845, 21846, 65536, 65537, 200000}) {
        check(0.0f, count, 1);
        check(0.0f, count, 2);
        check(0.0f, count, 3);
        check(0.0, count, 1);
    }
}

TEST_CASE("a file written after another has the bytes of one written alone", "[timeline]") {
    std::mt19937 random(5);
    constexpr std::size_t count = 1000;
    std::vector<std::vector<std::uint32_t>> values(6, std::vector<std::uint32_t>(count, 7));
    const std::vector<float> points(3 * count, 0.5f);
    const TemporaryFolder folder;
    VtkFile file;
    for (int step = 0; step < 30; ++step) {
        INFO("step " << step);
        const std::size_t changed = random() % values.size();
        values[changed][random() % count] = static_cast<std::uint32_t>(random());
        std::vector<DataArray> arrays;
        const std::size_t shown = step % 7 == 3 ? 3 : values.size();  // arrays come and go
        for (std::size_t i = 0; i < shown; ++i) {
            arrays.push_back(
                data_array<std::uint32_t>(std::string(1, char('a' + i)), std::span<const std::uint32_t>(values[i])));
            arrays.back().changed = i == changed;
        }
        step == 0 ? file.begin("PolyData") : file.begin_after("PolyData");
        fill_points(file, folder.path() / "after.vtp", points, arrays);
        write_points(folder.path() / "alone.vtp", count, arrays);
        CHECK((read_text(folder.path() / "after.vtp") == read_text(folder.path() / "alone.vtp")));
    }
}

TEST_CASE("arrays of several components read back, also where they do not fill blocks evenly", "[timeline]") {
    const std::size_t count = 200001;
    std::vector<float> vectors(3 * count);
    std::iota(vectors.begin(), vectors.end(), 0.25f);
    std::vector<std::uint8_t> colours;
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i < count; i += 3) {
        for (const std::uint32_t k : {i, 2 * i, 7 * i}) colours.push_back(static_cast<std::uint8_t>(k));
        ends.push_back(std::min<std::uint32_t>(i + 3, count));
    }
    DataArray rgb = data_array<std::uint8_t>("rgb", std::span<const std::uint8_t>(colours), 3);
    rgb.tuples = count;
    rgb.ends = ends;
    const TemporaryFolder folder;
    write_points(folder.path() / "a.vtp", count,
                 {data_array<float>("vectors", std::span<const float>(vectors), 3), rgb});
    const auto data = read(folder.path() / "a.vtp");
    CHECK((bytes_read(data, "vectors") == bytes_of(vectors)));
    vtkDataArray* array = data->GetPointData()->GetArray("rgb");
    REQUIRE(array);
    REQUIRE(array->GetNumberOfComponents() == 3);
    for (const vtkIdType i : {0, 1, 2, 3, 87380, 87381, 87382, 200000}) {
        CHECK(array->GetComponent(i, 2) == static_cast<std::uint8_t>(7 * (i / 3 * 3)));
    }
}

TEST_CASE("a file without points, with texts of any content, opens", "[timeline]") {
    const TemporaryFolder folder;
    const std::vector<std::string> texts{"", "plain", "<&\">", "ä", ""};
    write_points(folder.path() / "a.vtp", 0, {data_array<float>("empty", {})}, texts);
    const auto data = read(folder.path() / "a.vtp");
    CHECK(data->GetNumberOfPoints() == 0);
    CHECK(data->GetPointData()->GetArray("empty"));
    CHECK(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0) == 2.5);
    CHECK(data->GetFieldData()->GetArray("step")->GetTuple1(0) == 7);
    auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("a <b> & \"c\""));
    REQUIRE(array);
    REQUIRE(array->GetNumberOfValues() == vtkIdType(texts.size()));
    for (std::size_t i = 0; i < texts.size(); ++i) CHECK(array->GetValue(vtkIdType(i)) == texts[i]);
}

// ParaView 5.11 of Debian 12, with the system's expat as updated since, cannot read appended data: it opened no frame.
TEST_CASE("files for viewers keep their data inline, which every reader understands", "[timeline]") {
    const TemporaryFolder folder;
    const std::vector<double> values(10000, 0.1);
    write_points(folder.path() / "a.vtp", values.size(), {data_array<double>("values", std::span(values))});
    const std::string text = read_text(folder.path() / "a.vtp");
    CHECK(text.find("<AppendedData") == std::string::npos);
    CHECK(text.find("format=\"binary\"") != std::string::npos);
    CHECK(text.find("compressor=\"vtkLZ4DataCompressor\"") != std::string::npos);
    CHECK(text.size() < 10000);
}

TEST_CASE("a large file has the same bytes with any number of threads", "[timeline]") {
    std::mt19937 random(2);
    const std::vector<std::uint64_t> numbers = mixed_values<std::uint64_t>(1000000, random);
    const std::vector<float> floats = mixed_values<float>(1000000, random);
    const TemporaryFolder folder;
    std::string first;
    for (const std::size_t threads : {1, 2, 8}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        write_points(
            folder.path() / "a.vtp", 1000000,
            {data_array<std::uint64_t>("numbers", std::span(numbers)), data_array<float>("floats", std::span(floats))});
        const std::string text = read_text(folder.path() / "a.vtp");
        if (first.empty()) first = text;
        CHECK((text == first));
    }
}

TEST_CASE("a file that finds no room is not there, and says why", "[timeline]") {
    std::mt19937 random(3);
    std::vector<std::uint64_t> noise(100000);
    for (std::uint64_t& value : noise) value = random();
    const TemporaryFolder folder;
    const SmallDisk disk(100000);
    CHECK_THROWS_AS(
        write_points(folder.path() / "a.vtp", noise.size(), {data_array<std::uint64_t>("n", std::span(noise))}),
        RunError);
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("zlib holds the same values in fewer bytes, and the file says so", "[timeline]") {
    const TemporaryFolder folder;
    std::vector<float> points(3 * 40000);
    std::vector<std::uint64_t> identities(40000);
    std::mt19937_64 random(11);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<float>(i / 64) * 0.125f;
    for (std::size_t i = 0; i < identities.size(); ++i) identities[i] = i % 5 == 0 ? random() : identities[i - 1];
    const std::vector<DataArray> arrays{data_array<std::uint64_t>("identity", identities)};
    const auto write = [&](const std::string& name, Compression compression) {
        VtkFile file(compression);
        file.begin("PolyData");
        fill_points(file, folder.path() / name, points, arrays);
        return folder.path() / name;
    };
    const auto lz4 = write("lz4.vtp", Compression::lz4), zlib = write("zlib.vtp", Compression::zlib);
    CHECK(read_text(lz4).find("vtkLZ4DataCompressor") != std::string::npos);
    CHECK(read_text(zlib).find("vtkZLibDataCompressor") != std::string::npos);
    CHECK(std::filesystem::file_size(zlib) < std::filesystem::file_size(lz4));
    const auto data = read(zlib);
    REQUIRE(data->GetNumberOfPoints() == 40000);
    for (vtkIdType i = 0; i < 40000; i += 1111) {
        for (int k = 0; k < 3; ++k)
            CHECK(data->GetPoint(i)[k] == points[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(k)]);
    }
    CHECK(read(lz4)->GetPointData()->GetArray("identity")->GetVariantValue(39999) ==
          data->GetPointData()->GetArray("identity")->GetVariantValue(39999));
}

TEST_CASE("a normal that the four corners of a leaf share takes little more than one", "[timeline]") {
    std::mt19937 numbers(12);
    std::normal_distribution<float> number;
    std::vector<float> normals;
    for (int leaf = 0; leaf < 20000; ++leaf) {
        const std::array<float, 3> normal{number(numbers), number(numbers), number(numbers)};
        for (int corner = 0; corner < 4; ++corner) normals.insert(normals.end(), normal.begin(), normal.end());
    }
    for (const Compression compression : {Compression::lz4, Compression::zlib}) {
        Column<char> text;
        encode(data_array<float>("Normals", normals, 3), compression, text);
        const double of_one = 12 * 20000 * (4.0 / 3);  // in base64
        CHECK(double(text.size()) < 1.6 * of_one);
    }
}
