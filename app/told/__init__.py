"""Types of the messages between server and page; the page's own types are generated from them."""
