// SPDX-License-Identifier: BSD-3-Clause
#include "common/ros/image_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <boost/weak_ptr.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/ros/geometry_conversion.h"
#include "test/testing/message_of.h"

namespace plm_vins {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr int64_t kImageStamp =
    1403636579763555584;  // from EuRoC; exceeds the precision of a double

// A 6 x 4 image whose pixels all consist of the bytes `pixel`.
sensor_msgs::Image MakeImage(const std::string& encoding, const std::vector<uint8_t>& pixel) {
  sensor_msgs::Image image;
  image.header.stamp = ToRosTime(kImageStamp);
  image.encoding = encoding;
  image.width = 6;
  image.height = 4;
  image.step = static_cast<uint32_t>(6 * pixel.size());
  for (int i = 0; i < 24; ++i) image.data.insert(image.data.end(), pixel.begin(), pixel.end());
  return image;
}

struct EncodingCase {
  std::string encoding;
  std::vector<uint8_t> pixel;
  double gray;
};

class ImageEncodings : public ::testing::TestWithParam<EncodingCase> {};

TEST_P(ImageEncodings, AreConvertedToGray) {
  const ImageSample sample = ToImageSample(MakeImage(GetParam().encoding, GetParam().pixel));
  EXPECT_EQ(sample.t_ns, kImageStamp);
  ASSERT_EQ(sample.gray.type(), CV_8UC1);
  ASSERT_EQ(sample.gray.size(), cv::Size(6, 4));
  EXPECT_NEAR(sample.gray.at<uint8_t>(2, 3), GetParam().gray, 1);
}

// Luma: 0.299 R + 0.587 G + 0.114 B. 16-bit pixels are little endian.
INSTANTIATE_TEST_SUITE_P(Encodings, ImageEncodings,
                         ::testing::Values(EncodingCase{encodings::MONO8, {90}, 90},
                                           EncodingCase{encodings::TYPE_8UC1, {90}, 90},
                                           EncodingCase{encodings::BGR8, {10, 100, 200}, 119.6},
                                           EncodingCase{encodings::RGB8, {10, 100, 200}, 84.5},
                                           EncodingCase{
                                               encodings::BGRA8, {10, 100, 200, 255}, 119.6},
                                           EncodingCase{encodings::MONO16, {0x00, 0x80}, 127.5},
                                           EncodingCase{encodings::TYPE_16UC1, {0x00, 0x80}, 127.5},
                                           EncodingCase{encodings::BAYER_RGGB8, {60}, 60}));

TEST(ImageConversion, ConvertsBigEndianPixels) {
  for (const std::string& encoding :
       {encodings::MONO16, encodings::TYPE_16UC1, encodings::BAYER_RGGB16}) {
    sensor_msgs::Image image = MakeImage(encoding, {0x80, 0x10});
    image.width = 5;  // each row has unused bytes
    image.is_bigendian = 1;
    const cv::Mat gray = ToImageSample(image).gray;
    ASSERT_EQ(gray.type(), CV_8UC1) << encoding;
    ASSERT_EQ(gray.size(), cv::Size(5, 4)) << encoding;
    for (const uint8_t pixel : cv::Mat_<uint8_t>(gray)) EXPECT_NEAR(pixel, 127.7, 1) << encoding;
  }
}

TEST(ImageConversion, IgnoresTheByteOrderOfSingleBytePixels) {
  sensor_msgs::Image image = MakeImage(encodings::BGR8, {10, 100, 200});
  image.is_bigendian = 1;
  EXPECT_NEAR(ToImageSample(image).gray.at<uint8_t>(2, 3), 119.6, 1);
}

TEST(ImageConversion, SharesGrayPixelsAndKeepsThem) {
  for (const std::string& encoding : {encodings::MONO8, encodings::TYPE_8UC1}) {
    auto message = boost::make_shared<const sensor_msgs::Image>(MakeImage(encoding, {90}));
    const boost::weak_ptr<const sensor_msgs::Image> watched = message;
    ImageSample sample = ToImageSample(sensor_msgs::ImageConstPtr(message));
    EXPECT_EQ(sample.gray.data, message->data.data()) << encoding;
    message.reset();
    EXPECT_FALSE(watched.expired()) << encoding;
    sample = {};
    EXPECT_TRUE(watched.expired()) << encoding;
  }
}

TEST(ImageConversion, CopiesThePixelsOfABorrowedMessage) {
  const sensor_msgs::Image message = MakeImage(encodings::MONO8, {90});
  EXPECT_NE(ToImageSample(message).gray.data, message.data.data());
}

TEST(ImageConversion, ErrorNamesTheEncoding) {
  EXPECT_THAT(testing::MessageOf([] {
                ToImageSample(MakeImage("32SC1", {0, 0, 0, 0}));
              }),
              ::testing::HasSubstr("32SC1"));
}

TEST(ImageConversion, RejectsTooFewBytes) {
  sensor_msgs::Image image = MakeImage(encodings::MONO8, {90});
  image.data.resize(10);
  EXPECT_THROW(ToImageSample(image), std::invalid_argument);
}

TEST(ImageConversion, AcceptsPaddedRows) {
  sensor_msgs::Image image = MakeImage(encodings::MONO8, {90});
  image.width = 5;
  EXPECT_EQ(ToImageSample(image).gray.size(), cv::Size(5, 4));
}

void ExpectRefused(const std::string& encoding, cv::Size size, uint32_t step, size_t bytes) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = static_cast<uint32_t>(size.width);
  image.height = static_cast<uint32_t>(size.height);
  image.step = step;
  image.data.resize(bytes);
  EXPECT_THROW(ToImageSample(image), std::invalid_argument) << encoding;
}

// In 32-bit arithmetic, height * step equals the number of bytes, and width * 4 equals the step.
TEST(ImageConversion, RejectsSizesThatOverflow32Bits) {
  ExpectRefused(encodings::MONO8, {752, 480}, (1U << 27) + 752, 752 * 480);
  ExpectRefused(encodings::BGRA8, {(1 << 30) + 6, 4}, 24, 96);
}

TEST(ImageConversion, DecodesCompressedImages) {
  sensor_msgs::CompressedImage image;
  image.header.stamp = ToRosTime(kImageStamp);
  image.format = "png";
  cv::imencode(".png", cv::Mat(4, 6, CV_8UC1, cv::Scalar(77)), image.data);
  const ImageSample sample = ToImageSample(image);
  EXPECT_EQ(sample.t_ns, kImageStamp);
  EXPECT_EQ(sample.gray.at<uint8_t>(1, 1), 77);
  image.data.resize(20);
  EXPECT_THROW(ToImageSample(image), std::invalid_argument);
  image.data.clear();
  EXPECT_THROW(ToImageSample(image), std::invalid_argument);
}

// Headers only: OpenCV throws before it reads pixels.
TEST(ImageConversion, RejectsCompressedImagesThatClaimAbsurdSizes) {
  for (const auto& [width, height] : {std::pair(40000, 40000), std::pair((1 << 20) + 1, 1)}) {
    sensor_msgs::CompressedImage image;
    const std::string header = "P5 " + std::to_string(width) + " " + std::to_string(height);
    const std::string text = header + " 255\n" + std::string(100, 'x');
    image.data.assign(text.begin(), text.end());
    EXPECT_THROW(ToImageSample(image), std::invalid_argument) << header;
  }
}

}  // namespace
}  // namespace plm_vins
