"""How a robot is reached: an address, a connection for each protocol, and the messages that go both ways."""
