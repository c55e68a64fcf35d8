"""ROS bags and MCAP: their records, also of damaged files, their topics, and the messages in them."""
