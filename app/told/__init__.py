"""What crosses the network, as types: what comes in, what goes out, and what the page's own types are written from."""
