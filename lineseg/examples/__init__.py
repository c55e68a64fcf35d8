"""Small programs to read, run and build on. Each shows one thing.

In a checkout `python lineseg/examples/01_extract.py`; with a recording of your own, from anywhere,
`python -m lineseg.examples.01_extract corridor.bag`.
"""
