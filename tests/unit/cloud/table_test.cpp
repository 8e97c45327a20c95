// Columns of text clouds: chosen, named by a header or guessed; colours among them; and damaged
// tables.
#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/read.hpp>

#include "files.hpp"

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::read_cloud;

namespace {

using Columns = std::vector<std::string>;
using Colours = std::vector<dsc::cloud::Colour>;

class Table {
public:
    Cloud read(std::string_view text, const Columns& columns = {},
               std::string_view name = "a.csv") const {
        return read_cloud(folder_.write(name, text), nullptr, {columns});
    }
    std::string error(std::string_view text, const Columns& columns = {},
                      std::string_view name = "a.csv") const {
        const auto path = folder_.write(name, text);
        return folder_.strip(test::error_of([&] { read_cloud(path, nullptr, {columns}); }));
    }

private:
    test::Folder folder_;
};

const std::vector<Vec3> expected{{1, 2, 3}, {-4, 5.5, 6}};

}  // namespace

TEST_CASE("columns chosen by name, by number and by both") {
    const Table table;
    const std::string text = "id,Z,name,X,Y\n7,3,stone,1,2\n8,6,\"a, b\",-4,5.5\n";
    CHECK(table.read(text, {"X", "Y", "Z"}).points == expected);
    CHECK(table.read(text, {"x", "y", "z"}).points == expected);
    CHECK(table.read(text, {"4", "5", "2"}).points == expected);
    CHECK(table.read(text, {"x", "5", "Z"}).points == expected);
    CHECK(table.read("7 3 stone 1 2\n8 6 grass -4 5.5\n", {"4", "5", "2"}, "a.txt").points ==
          expected);
    CHECK(table.read("x,X,y,z\n0,1,2,3\n0,-4,5.5,6\n", {"X", "y", "z"}).points == expected);
    CHECK(table
              .read("\"Points:0\",\"Points:1\",\"say \"\"z\"\"\"\n1,2,3\n-4,5.5,6\n",
                    {"Points:0", "Points:1", "say \"z\""})
              .points == expected);
    // The format that is told.
    test::Folder folder;
    dsc::cloud::ReadReport report;
    read_cloud(folder.write("b.csv", text), &report, {{"X", "Y", "Z"}});
    CHECK(report.format == "CSV");
    CHECK(report.points == 2);
}

TEST_CASE("the separator is found: commas, semicolons, tabs, blanks") {
    const Table table;
    for (const char* text : {
             "east,north,up\n1,2,3\n-4,5.5,6\n",
             "east;north;up\r\n1;2;3\r\n-4;5.5;6\r\n",
             "east\tnorth\tup\n1\t2\t3\n-4\t5.5\t6\n",
             "east  north up\n1 2   3\n-4 5.5 6",
             "\"east\";\"north\";\"up\";\"note, long\"\n1;2;3;a, b\n-4;5.5;6;c\n",
             "// east north up\n1,2,3\n-4,5.5,6\n",
             "# of 2025\n# east,north,up\neast,north,up\n1,2,3\n-4,5.5,6\n",
         })
        CHECK_MESSAGE(table.read(text, {"east", "north", "up"}).points == expected, text);
    // Text with commas in a file whose columns are tabs.
    CHECK(
        table
            .read("name here\tx\ty\tz\nfoo, bar\t1\t2\t3\n\t-4\t5.5\t6\n", {"x", "y", "z"}, "a.txt")
            .points == expected);
}

TEST_CASE("without a choice the header's names decide, and prose does not") {
    const Table table;
    CHECK(table.read("id,x,y,z\n7,1,2,3\n8,-4,5.5,6\n").points == expected);
    CHECK(table.read("Z;Y;X\n3;2;1\n6;5.5;-4\n").points == expected);
    CHECK(table.read("//X,Y,Z,R,G,B\n1,2,3,255,0,9\n-4,5.5,6,1,2,3\n").colours ==
          Colours{{255, 0, 9}, {1, 2, 3}});
    CHECK(table.read("# columns: x y z\n1 2 3\n-4 5.5 6\n", {}, "a.xyz").points == expected);
    CHECK(table.read("####\n#\n//\n1 2 3\n-4 5.5 6\n", {}, "a.xyz").points == expected);
}

TEST_CASE("the usual names of coordinates are known, with their units, in any order") {
    const Table table;
    for (const char* text : {
             "Point,X [m],Y [m],Z [m]\n7,1,2,3\n8,-4,5.5,6\n",
             "id;Northing (m);Easting (m);Elevation\n7;2;1;3\n8;5.5;-4;6\n",
             "height,EAST,north\n3,1,2\n6,-4,5.5\n",
             "\"Points:0\",\"Points:1\",\"Points:2\",scalar\n1,2,3,9\n-4,5.5,6,9\n",
             "X_coord Y_coord Z_coord\n1 2 3\n-4 5.5 6\n",
             "X [m] Y [m] Z [m]\n1 2 3\n-4 5.5 6\n",
             "easting,northing,x,y,z\n100,200,1,2,3\n100,200,-4,5.5,6\n",
             "name,x,y,altitude\na,1,2,3\nb,-4,5.5,6\n",
         })
        CHECK_MESSAGE(table.read(text).points == expected, text);
}

TEST_CASE("a header that does not fit is never guessed past") {
    const Table table;
    const std::string ask = " does not say which columns are x, y and z; choose three columns by "
                            "their names or by their numbers from 1";
    CHECK(table.error("a,b,c\n1,2,3\n") == "io.columns 6: a.csv:1: the header 'a', 'b', 'c'" + ask);
    CHECK(table.error("PointID,Code,Value\n1,2,3\n") ==
          "io.columns 6: a.csv:1: the header 'PointID', 'Code', 'Value'" + ask);
    CHECK(table.error("longitude,latitude,height\n1,2,3\n").find(ask) != std::string::npos);
    CHECK(table.error("P1,1,2,3\nP2,4,5,6\n")
              .find("the first line contains words, but they do not say") != std::string::npos);
    CHECK(table.error("a scan of 2025\n1 2 3\n").find("the first line contains words") !=
          std::string::npos);
    CHECK(table.error("x,y,z\n1,2,3,4\n") == "io.syntax 6: a.csv:2: the header has 3 columns, the "
                                             "line 4; choose columns by their numbers from 1");
    CHECK(table.error("see x y z here\n1 2 3\n", {}, "a.xyz") ==
          "io.syntax 6: a.xyz:2: the header has 5 columns, the line 3; choose columns by their "
          "numbers from 1");
    // What the caller chose holds.
    CHECK(table.read("a,b,c\n1,2,3\n-4,5.5,6\n", {"1", "2", "3"}).points == expected);
    CHECK(table.read("see x y z here\n1 2 3\n-4 5.5 6\n", {"1", "2", "3"}, "a.xyz").points ==
          expected);
}

TEST_CASE("decimal commas are refused with one hint, however the columns are divided") {
    const Table table;
    const std::string hint = "' is not a number; write decimals with a point, not with a comma";
    for (const char* text : {
             "10,499 10,000 14,975\n",
             "10,499\t10,000\t14,975\n",
             "10,499;10,000;14,975\n",
             "10,499, 10,000, 14,975\n",
             "\"10,499\",\"10,000\",\"14,975\"\n",
             "x;y;z\n10,499;10,000;14,975\n",
             "x y z\n10,499 10,000 14,975\n",
             "x y z r g b\n10,499 10 14,975 1 2 3\n",
             "10,499,14,000,14,975\n",
             "10,499 1 -14,975e1\n",
             "1,010,499.5 1 2,000\n",
         })
        CHECK_MESSAGE(table.error(text).find(hint) != std::string::npos, text);
    CHECK(table.error("x,y,z\n10,499,10,100,14,975\n") ==
          "io.syntax 6: a.csv:2: the header has 3 columns, the line 6; write decimals with a "
          "point, not with a comma");
    CHECK(table.error("10,499 10,000 14,975\n", {"1", "2", "3"}).find(hint) != std::string::npos);
    for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
             {"a.obj", "v 1,5 2 3\n"},
             {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                       "y\nproperty float z\nend_header\n1,5 2 3\n"},
             {"a.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
                       "1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1,5 2 3\n"}})
        CHECK_MESSAGE(table.error(text, {}, name).find("'1,5" + hint) != std::string::npos, name);
    // Commas with blanks, and columns of whole numbers.
    CHECK(table.read("1, 2, 3\n-4, 5.5, 6\n").points == expected);
    CHECK(table.read("1 ,2 ,3\n-4 ,5.5 ,6\n").points == expected);
    CHECK(table.read("1,2,3,255,10,0\n-4,5.5,6,0,0,0\n").points == expected);
}

TEST_CASE("a byte order mark is not part of any cloud") {
    const Table table;
    const std::string mark = "\xEF\xBB\xBF";
    const std::string rows = "1 2 3\n-4 5.5 6\n";
    const std::string ply =
        "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
             {"a.xyz", rows},
             {"a.txt", "x y z\n" + rows},
             {"a.csv", "x,y,z\n1,2,3\n-4,5.5,6\n"},
             {"a.obj", "v 1 2 3\nv -4 5.5 6\n"},
             {"a.ply", "ply\nformat ascii 1.0\n" + ply + rows},
             {"a.ply",
              "ply\nformat ascii 1.0\nobj_info num_cols 7\nobj_info num_rows 2\n" + ply + rows},
             {"a.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
                       "2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n" +
                           rows}}) {
        CAPTURE(name);
        CHECK(table.read(text, {}, name).points == expected);
        CHECK(table.read(mark + text, {}, name).points == expected);
        CHECK(table.error("\xFF\xFE" + text, {}, name) ==
              "io.format 6: " + name +
                  ": the text is in UTF-16 or UTF-32; save it as UTF-8 or plain ASCII");
    }
    // Only an element makes a grid.
    CHECK(table
              .error(
                  "ply\nformat ascii 1.0\n" + ply.substr(0, ply.size() - 11) +
                      "element range_grid 1\nproperty list uchar int vertex_indices\nend_header\n" +
                      rows + "1 0\n",
                  {}, "a.ply")
              .find("range grid") != std::string::npos);
}

TEST_CASE("colours: of named columns, of chosen ones, of six columns") {
    const Table table;
    const Colours colours{{255, 128, 0}, {0, 0, 1}};
    CHECK(table.read("x,y,z,red,green,blue\n1,2,3,255,128,0\n-4,5.5,6,0,0,1\n").colours == colours);
    CHECK(table.read("x,y,z,intensity,R,G,B\n1,2,3,.5,255,128,0\n-4,5.5,6,.5,0,0,1\n").colours ==
          colours);
    CHECK(table
              .read("1 2 3 0.5 255 128 0\n-4 5.5 6 0.5 0 0 1\n", {"1", "2", "3", "5", "6", "7"},
                    "a.pts")
              .colours == colours);
    CHECK(table.read("1 2 3 255 128 0\n-4 5.5 6 0 0 1\n", {}, "a.xyz").colours == colours);
    // Fractions, bytes of a dark cloud, sixteen bits.
    CHECK(table.read("x,y,z,r,g,b\n1,2,3,1,0.5,0\n-4,5.5,6,0,0,1\n").colours ==
          Colours{{255, 128, 0}, {0, 0, 255}});
    CHECK(table.read("x,y,z,r,g,b\n1,2,3,1,0,0\n-4,5.5,6,0,0,1\n").colours ==
          Colours{{1, 0, 0}, {0, 0, 1}});
    CHECK(table.read("x,y,z,r,g,b\n1,2,3,65535,32768,0\n-4,5.5,6,0,0,257\n").colours ==
          Colours{{255, 128, 0}, {0, 0, 1}});
    // Not colours: normals, other columns, missing values in a line.
    CHECK(table.read("1 2 3 0 0 1\n-4 5.5 6 0 0 1\n", {}, "a.xyz").colours.empty());
    CHECK(table.read("1 2 3 0 0.5 7\n-4 5.5 6 0 0 1\n", {}, "a.xyz").colours.empty());
    CHECK(table.read("1 2 3 9 9 256\n-4 5.5 6 0 0 1\n", {}, "a.xyz").colours.empty());
    CHECK(table.read("1 2 3 9 9 9 9\n-4 5.5 6 0 0 1 9\n", {}, "a.xyz").colours.empty());
    CHECK(table.read("x,y,z,nx,ny,nz\n1,2,3,9,9,9\n-4,5.5,6,9,9,9\n").colours.empty());
    CHECK(table.read("x,y,z,r,g,b\n1,2,3,9,9,9\n-4,5.5,6,,,\n").colours.empty());
    CHECK(table.read("x,y,z,r,g,b\n1,2,3,9,9,9\n-4,5.5,6,9,9,-1\n").colours.empty());
    CHECK(table.read("1 2 3 9 9 9\n-4 5.5 6 9 9 9\n", {"1", "2", "3"}, "a.xyz").colours.empty());
}

TEST_CASE("every wrong choice has a text of its own") {
    const Table table;
    const std::string text = "id,Z,X,Y\n7,3,1,2\n";
    CHECK(table.error(text, {"X", "Y"}) ==
          "io.columns 6: a.csv: 2 columns are chosen; choose 3 (x, y, "
          "z) or 6 (x, y, z, red, green, blue)");
    CHECK(table.error(text, {"X", "Y", "height"}) ==
          "io.columns 6: a.csv:1: no column has the name 'height'; choose of 'id', 'Z', 'X', 'Y' "
          "or a number from 1");
    CHECK(table.error("7,3,1,2\n", {"X", "Y", "Z"}) ==
          "io.columns 6: a.csv:1: no column has the name 'X'; the file seems to have no header; "
          "choose columns by their numbers from 1");
    CHECK(table.error(text, {"0", "1", "2"}) ==
          "io.columns 6: a.csv: column 0 is chosen; count columns from 1");
    CHECK(table.error(text, {"1", "1", "2"}) ==
          "io.columns 6: a.csv: column '1' is chosen twice; choose a different column for each "
          "coordinate and colour");
    CHECK(table.error(text, {"Z", "X", "2"}) ==
          "io.columns 6: a.csv: column '2' is chosen twice; choose a different column for each "
          "coordinate and colour");
    CHECK(table.error(text, {"2", "3", "99999999999999999999"}) ==
          "io.columns 6: a.csv:1: no column has the name '99999999999999999999'; choose of 'id', "
          "'Z', 'X', 'Y' or a number from 1");
    CHECK(table.error(text, {"2", "3", "9"}) ==
          "io.syntax 6: a.csv:2: the line has 4 columns, column 9 is needed; a point needs x, y "
          "and z, separated by blanks, commas or semicolons; the file may be cut off");
    CHECK(table.error(text, {"X", "Y", "id", "Z", "2", "3"}) ==
          "io.columns 6: a.csv: column '2' is chosen twice; choose a different column for each "
          "coordinate and colour");
    CHECK(table.error("x,y,z,c\n1,2,3,4\n5,6,7,8\n", {"x", "y", "z", "c", "5", "6"}) ==
          "io.syntax 6: a.csv:2: colour '' is not a number of at least 0; choose three columns of "
          "coordinates only, or correct the line");
    CHECK(table.error("x,y\n1,2,3\n", {"x", "y", "3"}) ==
          "io.syntax 6: a.csv:2: the header has 2 columns, the line 3; choose columns by their "
          "numbers from 1");
    for (const char* name : {"a.obj", "a.ply", "a.pcd"})
        CHECK(table.error("v 1 2 3\n", {"1", "2", "3"}, name) ==
              "io.columns 6: " + std::string(name) +
                  ": columns can be chosen only for text clouds; remove the choice of columns, or "
                  "convert the cloud to .csv");
}

TEST_CASE("damaged tables: a cloud of finite points or one IoError") {
    const test::Folder folder;
    const std::string good = "# of "
                             "2025\nid,\"x\",y,z,red,green,blue\n1,0.5,1e3,-2,255,0,7\n2,1.5,2,3,1,"
                             "2,3\n3,\"4\",5,6,9,9,9\n4,7,8,9.25,0,0,0\n";
    dsc::RandomStream random({11, 0, 0, 0});
    const std::vector<Columns> choices = {
        {}, {"x", "y", "z"}, {"2", "3", "4"}, {"x", "y", "z", "red", "green", "blue"}};
    int refused = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = good;
        for (std::uint64_t n = 1 + random.index(4); n > 0 && !text.empty(); --n) {
            const std::size_t at = random.index(text.size());
            const std::uint64_t kind = random.index(5);
            if (kind == 0) text[at] = static_cast<char>(random.index(256));
            if (kind == 1) text[at] = "0123456789-+.e\"\t,;# \n/"[random.index(22)];
            if (kind == 2) text.erase(at, 1 + random.index(12));
            if (kind == 3)
                text.insert(at, text.substr(random.index(text.size()), random.index(20)));
            if (kind == 4) text.resize(at);
        }
        try {
            const Cloud cloud = read_cloud(folder.write("a.csv", text), nullptr,
                                           {choices[random.index(choices.size())]});
            CHECK_FALSE(cloud.points.empty());
            for (const Vec3& p : cloud.points) CHECK(p.allFinite());
            CHECK((cloud.colours.empty() || cloud.colours.size() == cloud.points.size()));
        } catch (const dsc::IoError& error) {
            CHECK(std::string(error.what()).find('\n') == std::string::npos);
            ++refused;
        }
    }
    CHECK(refused > 500);
    CHECK(refused < 3900);
}
