#include "core/byte_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/vec3.hpp"

namespace pliant {
namespace {

TEST(ByteStream, GivesBackEveryValueInOrder) {
  ByteWriter out;
  out.write(42L);
  out.write(-0.0);
  out.write(std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}});
  out.write(std::string("a\0b", 3));
  out.write("literal");
  out.write(std::vector<double>{});
  out.write(std::numeric_limits<double>::quiet_NaN());

  ByteReader in(out.bytes());
  EXPECT_EQ(in.read<long>(), 42);
  EXPECT_TRUE(std::signbit(in.read<double>()));
  EXPECT_EQ(in.read_vector<Vec3>(), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(in.read_text(), std::string("a\0b", 3));
  EXPECT_EQ(in.read_text(), "literal");
  EXPECT_TRUE(in.read_vector<double>().empty());
  EXPECT_TRUE(std::isnan(in.read<double>()));
  EXPECT_NO_THROW(in.expect_end());
}

TEST(ByteStream, RefusesToReadPastTheEnd) {
  ByteWriter out;
  out.write(std::vector<double>{1, 2, 3});
  const auto bytes = out.take();
  EXPECT_TRUE(out.bytes().empty());
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    ByteReader in{std::span(bytes).first(kept)};
    EXPECT_THROW(in.read_vector<double>(), ByteStreamError) << kept;
    EXPECT_EQ(in.remaining(), kept);
  }
}

TEST(ByteStream, RefusesALengthThatOverflows) {
  ByteWriter out;
  out.write(std::numeric_limits<std::uint64_t>::max() / 2);
  ByteReader in(out.bytes());
  EXPECT_THROW(in.read_vector<double>(), ByteStreamError);
  EXPECT_THROW(in.read_text(), ByteStreamError);
}

TEST(ByteStream, TellsOfBytesLeftOver) {
  ByteWriter out;
  out.write(1);
  out.write(2);
  ByteReader in(out.bytes());
  in.read<int>();
  EXPECT_THROW(in.expect_end(), ByteStreamError);
}

}  // namespace
}  // namespace pliant
