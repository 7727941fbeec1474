# SPDX-License-Identifier: BSD-3-Clause
"""ROS bags of sensor_msgs/Imu and images."""

import numpy as np
import rosbag
import rospy

from .measurements import Measurements

IMU_TYPE = "sensor_msgs/Imu"
IMAGE_TYPES = ("sensor_msgs/Image", "sensor_msgs/CompressedImage")


def make_faulty(source, target, apply, begin):
    """Modifies all topics of these types; copies other messages."""
    with _open(source) as bag:
        topics = bag.get_type_and_topic_info().topics
        types = {name: topic.msg_type for name, topic in topics.items()}
        imu_topics = [name for name, kind in types.items() if kind == IMU_TYPE]
        image_topics = [name for name, kind in types.items() if kind in IMAGE_TYPES]
        if not imu_topics or not image_topics:
            raise ValueError(f"{source}: no {IMU_TYPE} or no image in it")
        measurements = _measurements(bag, imu_topics, image_topics)
        apply(measurements, begin)
        with rosbag.Bag(target, "w") as output:
            _copy(bag, output, measurements, imu_topics, image_topics)


def _open(source):
    try:
        return rosbag.Bag(source)
    except (rosbag.ROSBagException, UnicodeDecodeError) as error:
        raise ValueError(f"{source} is not a ROS bag, or is damaged; \"rosbag reindex\" may repair"
                         " it") from error


def _measurements(bag, imu_topics, image_topics):
    imu = [message for _, message, _ in bag.read_messages(imu_topics)]
    image_ns = [message.header.stamp.to_nsec() for _, message, _ in bag.read_messages(image_topics)]
    return Measurements(
        np.array([message.header.stamp.to_nsec() for message in imu]),
        np.array([_vector(message.angular_velocity) for message in imu]),
        np.array([_vector(message.linear_acceleration) for message in imu]),
        np.array(image_ns))


def _copy(bag, output, measurements, imu_topics, image_topics):
    imu, image, repeated = 0, 0, None
    for topic, message, received in bag.read_messages():
        if topic in image_topics:
            if measurements.shown[image] == image:
                repeated = message.data
            message.data = repeated
            message.header.stamp = _time(measurements.image_ns[image])
            image += 1
        elif topic in imu_topics:
            _set(measurements, imu, message)
            imu += 1
            if not measurements.imu_kept[imu - 1]:
                continue
        output.write(topic, message, received)


def _set(measurements, index, message):
    message.header.stamp = _time(measurements.imu_ns[index])
    for vector, values in ((message.angular_velocity, measurements.gyro[index]),
                           (message.linear_acceleration, measurements.accel[index])):
        vector.x, vector.y, vector.z = values


def _vector(message):
    return [message.x, message.y, message.z]


def _time(t_ns):
    return rospy.Time(*divmod(int(t_ns), 10**9))
