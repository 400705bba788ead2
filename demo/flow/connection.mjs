// The connection node of a PLC. Writes and remote control are ticked: this plant is a simulated one.

export const connectionId = (plc) => `${plc.id}-connection`

/** What every family has. */
function common(plc) {
  return {
    id: connectionId(plc),
    type: 'melsec-jw-connection',
    name: plc.title,
    host: '127.0.0.1',
    port: `\${${plc.portVariable}}`,
    transport: 'tcp',
    localAddress: '',
    localPort: '',
    timeout: '3000',
    encoding: 'shift-jis',
    wordOrder: 'low-first',
    allowWrites: true,
    allowControl: true,
  }
}

const families = {
  melsec: ({ profile, frame }) => ({
    version: 1,
    profile,
    code: 'binary',
    frame,
    network: '0',
    station: '255',
    moduleIo: '3FF',
    multidrop: '0',
    monitoringTimer: '',
    probe: 'auto',
    inFlight: '1',
    gap: '64',
    xyRadix: '',
    asciiXy: '',
    asciiZr: '',
  }),
  jw: ({ simulator }) => ({
    version: 3,
    family: 'jw',
    way: 'ethernet',
    model: simulator.model,
    header: 'none',
    headerBytes: '',
    pda: '',
    psa: '',
    slot: '',
    relayStation: '',
    jwProbe: 'writeMode',
    gapBytes: '128',
    lists: 'true',
    marker: 'once',
    maxData: '',
    areas: 'printed',
    ownAreas: '',
    reconnectFirst: '',
    reconnectLongest: '',
    queueLimit: '',
    allowParameters: false,
  }),
}

export function connection(plc) {
  return { ...common(plc), ...families[plc.family](plc) }
}
