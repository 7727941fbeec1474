#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which data test/tools/make_faulty.py changes, and which it keeps."""

import importlib.util
import os
import shutil
import struct
import sys
import tempfile
import unittest

import numpy as np

from refusal_case import RefusalTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
from make_faulty import main  # noqa: E402
from stress.faults import FAULTS  # noqa: E402
from stress.feature_file import (IMU, IMU_LAYOUT, LINE_SIZE, LINE_STATISTICS_SIZE,  # noqa: E402
                                 POINT, POINT_STATISTICS_SIZE, POINTS, POINTS_AND_LINES, SIGNATURE,
                                 SIZE, TRACKING, Features)
from stress.measurements import Measurements  # noqa: E402

START_NS = 1403636579758555392
HEADER = SIGNATURE + SIZE.pack(11) + b'{"freq":10}'


def flight(seconds=4):
    """IMU at 200 Hz, images at 20 Hz."""
    samples, images = 200 * seconds, 20 * seconds
    values = np.tile([0.1, 0.2, 0.3], (samples, 1))
    return Measurements(START_NS + 5_000_000 * np.arange(samples), values.copy(), 9 + values,
                        START_NS + 50_000_000 * np.arange(images))


class Faults(unittest.TestCase):
    def damaged(self, name, begin=1.0):
        measurements = flight()
        FAULTS[name].apply(measurements, begin)
        return measurements

    def test_nothing_changes_before_the_fault(self):
        for name in set(FAULTS) - {"image_delay"}:
            good, bad = flight(), self.damaged(name, begin=2.0)
            for field in ("imu_ns", "gyro", "accel", "imu_kept"):
                np.testing.assert_array_equal(getattr(bad, field)[:400], getattr(good, field)[:400],
                                              f"{name} {field}")
            np.testing.assert_array_equal(bad.image_ns[:40], good.image_ns[:40], name)

    def test_every_fault_but_none_changes_something(self):
        for name in FAULTS:
            good, bad = flight(), self.damaged(name)
            same = all(np.array_equal(getattr(good, field), getattr(bad, field))
                       for field in vars(good))
            # The flight is at standstill and thus far from the limits of a sensor.
            self.assertEqual(same, name in ("none", "imu_saturated", "imu_held_100ms"), name)

    def test_a_fault_that_would_begin_after_the_end(self):
        for name in set(FAULTS) - {"none", "image_delay"}:
            with self.assertRaisesRegex(ValueError, "--begin 9: the recording lasts 4.0 s"):
                self.damaged(name, begin=9)
            with self.assertRaisesRegex(ValueError, "--begin 3.99: "):  # there is no later image
                self.damaged(name, begin=3.99)
        self.damaged("none", begin=9)
        self.damaged("image_delay", begin=9)

    def test_sizes(self):
        self.assertAlmostEqual(
            np.linalg.norm(self.damaged("gyro_bias_step").gyro[-1] - flight().gyro[-1]), 0.05)
        self.assertEqual((self.damaged("accel_spike").accel == 150).sum(), 1)
        self.assertEqual((self.damaged("gyro_three").gyro == 40).sum(), 3)
        self.assertEqual((self.damaged("accel_spikes_1hz").accel == 150).sum(), 3)
        self.assertEqual(self.damaged("imu_halved").imu_kept.sum(), 200 + 300)
        jitter = self.damaged("image_jitter").image_ns - flight().image_ns
        self.assertLessEqual(abs(jitter).max(), 5_000_000)
        self.assertGreater(abs(jitter).max(), 4_000_000)


class Files(RefusalTest):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "wb") as file:
            file.write(content)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def features(self):
        """Twenty samples, with an image of two points after every tenth."""
        content = HEADER
        for i in range(20):
            content += bytes([IMU]) + IMU_LAYOUT.pack(START_NS + 5_000_000 * i, *range(6))
            if i % 10 == 0:
                content += bytes([POINTS]) + TRACKING.pack(START_NS + 5_000_000 * i, False, True, 1)
                content += bytes(POINT_STATISTICS_SIZE) + SIZE.pack(2) + bytes(2 * POINT.itemsize)
        self.write("good.feat", content)
        return self.path("good.feat")

    def test_features_without_a_fault_are_the_same_bytes(self):
        self.assertEqual(main([self.features(), self.path("bad.feat"), "--fault", "none"]), 0)
        self.assertEqual(self.read("bad.feat"), self.read("good.feat"))

    def test_features_with_faults(self):
        for fault, size in (("imu_halved", -10 * (1 + IMU_LAYOUT.size)),
                            ("points_gone_10s", -4 * POINT.itemsize), ("accel_spike", 0)):
            self.assertEqual(main([self.features(), self.path("bad.feat"), "--fault", fault,
                                   "--begin", "0"]), 0)
            self.assertEqual(len(self.read("bad.feat")) - len(self.read("good.feat")), size, fault)
        self.assertEqual(Features(self.path("bad.feat")).measurements().accel[0, 0], 150)

    def test_features_of_a_repeated_image(self):
        content = HEADER + bytes([IMU]) + IMU_LAYOUT.pack(START_NS, *range(6))
        for i in range(3):
            points = np.zeros(1 + i, POINT)
            points["uv"], points["velocity"] = 7 * i, 0.5
            head = TRACKING.pack(START_NS + 50_000_000 * i, False, True, 1)
            content += (bytes([POINTS_AND_LINES]) + head + bytes(POINT_STATISTICS_SIZE)
                        + SIZE.pack(len(points)) + points.tobytes() + head
                        + bytes(LINE_STATISTICS_SIZE) + SIZE.pack(1) + bytes([i]) * LINE_SIZE)
        content += bytes([IMU]) + IMU_LAYOUT.pack(START_NS + 200_000_000, *range(6))
        self.write("good.feat", content)
        self.assertEqual(main([self.path("good.feat"), self.path("bad.feat"), "--fault",
                               "image_frozen_3s", "--begin", "0.09"]), 0)
        repeated = np.zeros(2, POINT)
        repeated["uv"] = 7
        bad = self.read("bad.feat")
        self.assertIn(TRACKING.pack(START_NS + 100_000_000, False, True, 1)
                      + bytes(POINT_STATISTICS_SIZE) + SIZE.pack(2) + repeated.tobytes(), bad)
        self.assertEqual((bad.count(bytes([1]) * LINE_SIZE), bad.count(bytes([2]) * LINE_SIZE)),
                         (2, 0))

    def write_asl(self):
        imu = "".join(f"{START_NS + 5_000_000 * i},0,0,0,0,0,9.81\n" for i in range(20))
        self.write("good/mav0/imu0/data.csv", b"#timestamp [ns],w,w,w,a,a,a\n" + imu.encode())
        images = f"#timestamp [ns],filename\n{START_NS},a.png\n{START_NS + 95_000_000},b.png\n"
        self.write("good/mav0/cam0/data.csv", images.encode())
        self.write("good/mav0/cam0/data/a.png", b"picture")

    def test_asl_folder(self):
        self.write_asl()
        self.write("good/mav0/body.yaml", b"comment: body")
        self.assertEqual(main([self.path("good"), self.path("bad"), "--fault", "gyro_spike",
                               "--begin", "0.05"]), 0)
        rows = self.read("bad/imu0/data.csv").decode().splitlines()
        self.assertEqual(len(rows), 21)
        self.assertEqual([row.split(",")[1] for row in rows].count("40.0"), 1)
        self.assertEqual(self.read("bad/cam0/data/a.png"), b"picture")
        self.assertEqual(self.read("bad/body.yaml"), b"comment: body")
        self.assertIn("a.png", self.read("bad/cam0/data.csv").decode())

    def test_asl_folder_with_a_repeated_image(self):
        self.write_asl()
        self.assertEqual(main([self.path("good"), self.path("bad"), "--fault", "image_frozen_3s",
                               "--begin", "0.05"]), 0)
        self.assertEqual(self.read("bad/cam0/data.csv").decode().splitlines()[1:],
                         [f"{START_NS},a.png", f"{START_NS + 95_000_000},a.png"])

    def test_a_fault_after_the_end_of_a_file(self):
        self.write_asl()
        good = [self.features(), self.path("good")]
        if importlib.util.find_spec("rosbag"):
            self.write_bag(self.path("good.bag"))
            good.append(self.path("good.bag"))
        for source in good:
            self.assert_refused(main, "--begin 24: the recording lasts 0.", source,
                                self.path("bad"), "--fault", "accel_spike")
            self.assertFalse(os.path.exists(self.path("bad")), source)
            self.assertEqual(main([source, self.path("bad"), "--fault", "none"]), 0)
            (shutil.rmtree if os.path.isdir(source) else os.remove)(self.path("bad"))

    def test_asl_folder_is_not_overwritten(self):
        self.write_asl()
        good = self.read("good/mav0/imu0/data.csv")
        os.symlink(self.path("good", "mav0"), self.path("link"))
        for target in ("good", "good/mav0", "link"):
            self.assert_refused(main, "make_faulty.py: ", self.path("good"), self.path(target),
                                "--fault", "gyro_spike", "--begin", "0.05")
        self.assertEqual(self.read("good/mav0/imu0/data.csv"), good)
        self.assertEqual(sorted(os.listdir(self.path("good"))), ["mav0"])

    def test_asl_folder_does_not_mix_with_another(self):
        self.write_asl()
        self.write("other/cam0/data/a.png", b"another picture")
        self.assert_refused(main, "already exists", self.path("good"), self.path("other"),
                            "--fault", "none")
        os.makedirs(self.path("empty"))
        self.assertEqual(main([self.path("good"), self.path("empty"), "--fault", "none"]), 0)
        self.assertEqual(self.read("empty/cam0/data/a.png"), b"picture")

    def test_asl_folder_without_a_row(self):
        self.write_asl()
        self.write("good/mav0/imu0/data.csv", b"#timestamp [ns],w,w,w,a,a,a\n")
        self.assert_refused(main, self.path("good"), self.path("good"), self.path("bad"), "--fault",
                            "none")
        self.assertFalse(os.path.exists(self.path("bad")))

    @unittest.skipUnless(importlib.util.find_spec("rosbag"), "needs ROS")
    def test_bag(self):
        self.write_bag(self.path("good.bag"))
        for fault, samples in (("none", 40), ("imu_halved", 25), ("image_step", 40)):
            self.assertEqual(main([self.path("good.bag"), self.path("bad.bag"), "--fault", fault,
                                   "--begin", "0.05"]), 0)
            imu, images = self.read_bag(self.path("bad.bag"))
            self.assertEqual(len(imu), samples, fault)
            self.assertEqual(len(images), 4)
            step_ns = 20_000_000 if fault == "image_step" else 0
            self.assertEqual(images[1].header.stamp.to_nsec(), START_NS + 50_000_000 + step_ns)
            self.assertEqual(images[1].data, bytes([1]) * 16)

    @unittest.skipUnless(importlib.util.find_spec("rosbag"), "needs ROS")
    def test_a_repeated_image_in_a_bag(self):
        self.write_bag(self.path("good.bag"))
        self.assertEqual(main([self.path("good.bag"), self.path("bad.bag"), "--fault",
                               "image_frozen_3s", "--begin", "0.05"]), 0)
        _, images = self.read_bag(self.path("bad.bag"))
        self.assertEqual([image.data[0] for image in images], [0, 0, 0, 0])
        self.assertEqual([image.header.stamp.to_nsec() for image in images],
                         [START_NS + 50_000_000 * i for i in range(4)])

    @unittest.skipUnless(importlib.util.find_spec("rosbag"), "needs ROS")
    def test_readings_in_a_bag(self):
        self.write_bag(self.path("good.bag"))
        self.assertEqual(main([self.path("good.bag"), self.path("bad.bag"), "--fault",
                               "accel_spike", "--begin", "0.05"]), 0)
        imu, _ = self.read_bag(self.path("bad.bag"))
        self.assertEqual([message.linear_acceleration.x for message in imu].count(150), 1)
        self.assertEqual(imu[10].linear_acceleration.x, 150)
        self.assertEqual(imu[10].linear_acceleration.z, 9.81)

    @unittest.skipUnless(importlib.util.find_spec("rosbag"), "needs ROS")
    def test_a_bag_that_is_none(self):
        self.write("other.bag", b"\xa2 no bag")
        self.assertEqual(main([self.path("other.bag"), self.path("x.bag"), "--fault", "none"]), 1)

    def test_a_recording_is_not_overwritten(self):
        self.features()
        good = self.read("good.feat")
        self.assertEqual(main([self.path("good.feat"), self.path("good.feat"), "--fault",
                               "accel_spike", "--begin", "0"]), 1)
        self.assertEqual(self.read("good.feat"), good)

    def write_bag(self, path):
        """Forty samples, with an image before every tenth."""
        import rosbag
        import rospy
        from sensor_msgs.msg import Image, Imu
        with rosbag.Bag(path, "w") as bag:
            for i in range(40):
                stamp = rospy.Time(0, START_NS + 5_000_000 * i)
                imu = Imu()
                imu.header.stamp, imu.linear_acceleration.z = stamp, 9.81
                bag.write("/imu0", imu, stamp)
                if i % 10 == 0:
                    gray = bytes([i // 10]) * 16
                    image = Image(encoding="mono8", width=4, height=4, step=4, data=gray)
                    image.header.stamp = stamp
                    bag.write("/cam0/image_raw", image, stamp)

    def read_bag(self, path):
        import rosbag
        with rosbag.Bag(path) as bag:
            messages = [(topic, message) for topic, message, _ in bag.read_messages()]
        return ([message for topic, message in messages if topic == "/imu0"],
                [message for topic, message in messages if topic != "/imu0"])

    def test_what_needs_features_says_so(self):
        os.makedirs(self.path("folder"))
        self.assertEqual(main([self.path("folder"), self.path("bad"), "--fault", "blind_10s"]), 1)

    def test_a_file_that_is_none(self):
        self.write("other.feat", struct.pack("<q", 1))
        self.assertEqual(main([self.path("other.feat"), self.path("x"), "--fault", "none"]), 1)

    def test_features_that_are_cut_off_or_damaged(self):
        head, points = TRACKING.pack(START_NS, False, True, 1), bytes(2 * POINT.itemsize)
        content = (HEADER + bytes([IMU]) + IMU_LAYOUT.pack(START_NS, *range(6))
                   + bytes([POINTS_AND_LINES]) + head + bytes(POINT_STATISTICS_SIZE)
                   + SIZE.pack(2) + points + head + bytes(LINE_STATISTICS_SIZE) + SIZE.pack(2)
                   + bytes(2 * LINE_SIZE))
        arguments = (self.path("cut.feat"), self.path("x"), "--fault", "none")
        for damaged in (*(content[:size] for size in range(len(content))), content + b"\x07"):
            self.write("cut.feat", damaged)
            self.assert_refused(main, self.path("cut.feat"), *arguments)
            self.assertFalse(os.path.exists(self.path("x")))
        self.write("cut.feat", content)
        self.assertEqual(main(arguments), 0)
        self.assertEqual(self.read("x"), content)


if __name__ == "__main__":
    unittest.main()
