#!/usr/bin/env python3
"""Checks ebus.dbc and the frames of the code with tools of others.

    pip install cantools==45.1.0 autosar-e2e==1.0.0
    cargo run -p supervisor-wire --example frames | python3 supervisor/wire/check_dbc.py

The DBC must load strictly and without a warning; every frame must decode by it; every frame with AUTOSAR E2E
Profile 11 must pass autosar-e2e, and must not pass with the data id of its neighbour.
"""
import pathlib
import sys
import warnings

import cantools
import e2e.p11

warnings.simplefilter("error")
dbc = cantools.database.load_file(pathlib.Path(__file__).with_name("ebus.dbc"), strict=True)
checked = {}
for line in sys.stdin:
    identifier, data = line.split()[2].split("#")
    frame_id, data = int(identifier, 16), bytearray.fromhex(data)
    message = dbc.get_message_by_frame_id(frame_id)
    message.decode(bytes(data))
    attributes = message.dbc.attributes
    if attributes["E2EProfile"].value == 1:
        data_id = attributes["E2EDataID"].value
        assert data_id == frame_id & 0xFFFF, message.name
        assert e2e.p11.e2e_p11_check(data, data_id), f"{message.name}: {line}"
        assert not e2e.p11.e2e_p11_check(data, data_id ^ 0x100), message.name
    checked[message.name] = checked.get(message.name, 0) + 1
missing = {message.name for message in dbc.messages} - checked.keys()
assert not missing, f"no frame of {sorted(missing)}"
print(f"{sum(checked.values())} frames of {len(checked)} messages: right")
