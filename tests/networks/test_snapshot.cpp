#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "files/error.hpp"
#include "fitting/networks/snapshot.hpp"
#include "sweeps/store/hdf5.hpp"

using namespace shakebed::fitting::networks;
using Catch::Matchers::Contains;

namespace {

class Folder {
 public:
  Folder()
      : path(std::filesystem::temp_directory_path() /
             ("shakebed-snapshot-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
  std::filesystem::path path;
};

Snapshot read(const Folder& folder, const std::string& grains, const std::string& contacts) {
  return read_snapshot_csv(folder.write("grains.csv", grains),
                           folder.write("contacts.csv", contacts));
}

const std::string three = "id,x,y,z,radius\n30,0,0,0,0.5\n10,1,0,0,0.5\n20,0,1,0,0.5\n";

}  // namespace

TEST_CASE("a plain pair of tables is a snapshot, in any order of rows") {
  const Folder folder;
  const auto bed = read(folder, three, "i,j,normal_force\n30,10,2.5\n20,30,-1\n10,,4\n10,20,0\n");
  CHECK(bed.id == std::vector<std::int64_t>{10, 20, 30});
  CHECK(bed.position[2] == Point{0, 0, 0});
  REQUIRE(bed.contacts.size() == 3);
  CHECK(bed.contacts[0].normal_force == 0);    // 10-20
  CHECK(bed.contacts[1].normal_force == 2.5);  // 10-30
  CHECK(bed.contacts[2].normal_force == -1);   // 20-30
  CHECK(bed.wall_contacts == 1);
  CHECK(bed.contacts_not_touching == 1);  // 10 and 20 are sqrt(2) apart
  CHECK(median_diameter(bed) == 1);
}

TEST_CASE("units in the header, further columns, decimals as ids and huge ids are understood") {
  const Folder folder;
  const auto bed = read(folder,
                        "# from elsewhere\nid [1],type,x [m],y [m],z [m],radius [m]\n"
                        "9007199254740991,1,0,0,0,0.5\n-4,2,0.9,0,0,0.5\n",
                        "i,j,normal_force [N],age\n-4,9007199254740991.0,1e-3,7\n-4.0,,2,7\n");
  CHECK(bed.id == std::vector<std::int64_t>{-4, 9007199254740991});
  CHECK(bed.contacts.size() == 1);
  CHECK(bed.wall_contacts == 1);
}

TEST_CASE("rounding to 6 digits is no gap") {
  const Folder folder;
  const std::string contacts = "i,j,normal_force\n1,2,1\n";
  // Truly 0.99999 apart at z = 54.1234.
  CHECK(read(folder, "id,x,y,z,radius\n1,0,0,54.1234,0.5\n2,0,0,55.1235,0.5\n", contacts)
            .contacts_not_touching == 0);
  CHECK(read(folder, "id,x,y,z,radius\n1,0,0,54.1234,0.5\n2,0,0,55.1334,0.5\n", contacts)
            .contacts_not_touching == 1);
}

TEST_CASE("bad grains are refused with their line") {
  const Folder folder;
  const std::string none = "i,j,normal_force\n", head = "id,x,y,z,radius\n1,0,0,0,0.5\n";
  const auto [row, message] = GENERATE(table<std::string, std::string>({
      {"2,nan,0,0,0.5", "finite x"},
      {"2,0,inf,0,0.5", "finite y"},
      {"2,0,0,-inf,0.5", "finite z"},
      {"2,,0,0,0.5", "finite x"},
      {"2,0,0,1e200,0.5", "finite z"},
      {"2,1,0,0,-0.5", "radius > 0, got -0.5"},
      {"2,1,0,0,0", "radius > 0, got 0"},
      {"2,1,0,0,nan", "radius > 0"},
      {"2,1,0,0,inf", "radius > 0"},
      {"1,1,0,0,0.5", "grain 1 is also given at"},
      {"2,0,0,0,0.5", "same point as grain 1"},
      {"2,-0,0,0,0.5", "same point as grain 1"},
      {"2.5,1,0,0,0.5", "id of a grain"},
      {"nan,1,0,0,0.5", "id of a grain"},
      {",1,0,0,0.5", "id of a grain"},
      {"1e300,1,0,0,0.5", "id of a grain"},
      {"two,1,0,0,0.5", "expected a number, got `two`"},
  }));
  INFO(row);
  CHECK_THROWS_WITH(read(folder, head + row + "\n", none),
                    Contains("grains.csv:3") && Contains(message));
}

TEST_CASE("bad contacts are refused with their line") {
  const Folder folder;
  const std::string head = "i,j,normal_force\n10,20,1\n";
  const auto [row, message] = GENERATE(table<std::string, std::string>({
      {"10,99,1", "names grain 99"},
      {"99,10,1", "names grain 99"},
      {"99,,1", "names grain 99"},
      {"30,30,1", "grain 30 with itself"},
      {"10,20,1", "grain 10 with grain 20 is also given at"},
      {"20,10,3", "grain 10 with grain 20 is also given at"},
      {"10,30,nan", "finite normal_force"},
      {"10,30,inf", "finite normal_force"},
      {"10,30,", "finite normal_force"},
      {"10,,nan", "finite normal_force"},
      {"10,3x,1", "expected a number"},
      {",10,1", "id of a grain"},
  }));
  INFO(row);
  CHECK_THROWS_WITH(read(folder, three, head + row + "\n"),
                    Contains("contacts.csv:3") && Contains(message));
}

TEST_CASE("all faults of a file are told at once, up to twenty") {
  const Folder folder;
  std::string grains = "id,x,y,z,radius\n";
  for (int k = 0; k < 50; ++k) grains += std::to_string(k) + ",nan,0,0,0.5\n";
  try {
    read(folder, grains, "i,j,normal_force\n");
    FAIL("accepted");
  } catch (const shakebed::files::Error& error) {
    CHECK(error.kind() == shakebed::files::Error::Kind::bad_input);
    CHECK(error.faults().size() == 21);
    CHECK_THAT(error.faults().back().what, Contains("30 more"));
  }
}

TEST_CASE("missing files, columns and rows are told") {
  const Folder folder;
  const std::string none = "i,j,normal_force\n";
  CHECK_THROWS_WITH(read_snapshot_csv(folder.path / "no.csv", folder.path / "no.csv"),
                    Contains("no.csv"));
  CHECK_THROWS_WITH(read(folder, "id,x,y,z,radii\n1,0,0,0,1\n", none), Contains("radius"));
  CHECK_THROWS_WITH(read(folder, three, "i,j,fn\n"), Contains("normal_force"));
  CHECK_THROWS_WITH(read(folder, "id,x,y,z,radius\n", none), Contains("no grains"));
  CHECK(read(folder, three, none).contacts.empty());
  CHECK(read(folder, "id,x,y,z,radius\n5,0,0,0,1\n", none).grains() == 1);
}

namespace {

using shakebed::sweeps::store::hdf5::Handle;

/// A file as /snapshots/NAME and /contacts/NAME, written by HDF5's own calls.
class SnapshotFile {
 public:
  explicit SnapshotFile(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {
    make("/snapshots");
    make("/contacts");
  }
  void make(const std::string& group) const {
    Handle(H5Gcreate2(file_.id(), group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }
  template <class Number>
  void write(const std::string& name, const std::vector<Number>& values,
             hsize_t columns = 1) const {
    const hid_t type = std::is_integral_v<Number> ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
    const hsize_t size[2] = {values.size() / columns, columns};
    const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
    const Handle data(H5Dcreate2(file_.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                 H5P_DEFAULT, H5P_DEFAULT),
                      H5Dclose);
    H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  void write_snapshot(const std::string& name) const {
    make("/snapshots/" + name);
    make("/contacts/" + name);
    write<std::int64_t>("/snapshots/" + name + "/id", {3, 1, 2});
    write<double>("/snapshots/" + name + "/position", {0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    write<double>("/snapshots/" + name + "/velocity", std::vector<double>(9, 0.0), 3);
    write<double>("/snapshots/" + name + "/radius", {0.5, 0.5, 0.5});
    write<std::int64_t>("/contacts/" + name + "/i", {3, 2, 1});
    write<std::int64_t>("/contacts/" + name + "/j", {1, 3, -1});
    write<double>("/contacts/" + name + "/normal_force", {2.5, -1, 4});
  }

 private:
  Handle file_;
};

}  // namespace

TEST_CASE("a snapshot of an HDF5 file") {
  const Folder folder;
  const auto path = folder.path / "run.h5";
  SECTION("the only one") {
    SnapshotFile(path).write_snapshot("T10");
    const auto bed = read_snapshot_hdf5(path);
    CHECK(bed.id == std::vector<std::int64_t>{1, 2, 3});
    CHECK(bed.position[0] == Point{1, 0, 0});
    CHECK(bed.contacts.size() == 2);
    CHECK(bed.contacts[0].normal_force == 2.5);
    CHECK(bed.wall_contacts == 1);
    CHECK(read_snapshot_hdf5(path.string() + ":T10").id == bed.id);
    CHECK_THROWS_WITH(read_snapshot_hdf5(path.string() + ":T11"),
                      Contains("run.h5:/snapshots/T11"));
  }
  SECTION("one of several") {
    {
      const SnapshotFile file(path);
      file.write_snapshot("T10");
      file.write_snapshot("T11");
    }
    CHECK_THROWS_WITH(read_snapshot_hdf5(path), Contains("T10") && Contains("T11"));
    CHECK(read_snapshot_hdf5(path.string() + ":T11").grains() == 3);
  }
  SECTION("a data set is missing, short or of another kind") {
    {
      const SnapshotFile file(path);
      file.make("/snapshots/a");
      file.make("/contacts/a");
      file.write<std::int64_t>("/snapshots/a/id", {1, 2});
      file.write<double>("/snapshots/a/position", {0, 0, 0}, 3);
    }
    CHECK_THROWS_WITH(read_snapshot_hdf5(path), Contains("/snapshots/a/radius"));
  }
  SECTION("cut short at any length") {
    SnapshotFile(path).write_snapshot("T10");
    const auto whole = std::filesystem::file_size(path);
    for (const auto part : {whole / 10, whole / 2, whole - 100, whole - 1}) {
      std::filesystem::resize_file(path, part);
      CHECK_THROWS_AS(read_snapshot_hdf5(path), shakebed::files::Error);
    }
  }
  SECTION("not HDF5, or not there") {
    CHECK_THROWS_WITH(read_snapshot_hdf5(folder.write("a.h5", "hello")), Contains("a.h5"));
    CHECK_THROWS_WITH(read_snapshot_hdf5(folder.path / "b.h5"), Contains("no such file"));
  }
}
