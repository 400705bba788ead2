import { declare, field } from '../../codec/codec'

const { countOf, text } = field

// The same fields in both. The FX5 communication manual (38.6) calls those of Lock "unused" without saying that they may
// be left out, so they are always sent as the SLMP manual draws them. How many characters: limits of the profile.
const request = {
  length: countOf('password', 2, { min: 4, max: 32 }),
  password: text('length', { charset: 'printable', secret: true, doc: 'sent as characters in both data codes' }),
} as const
const manual = 'SLMP reference manual 5.7'

/** Remote password: for the connected station only. A wrong password must not be sent again and again. */
export const passwordCommands = declare({
  unlock: {
    title: 'Unlock (remote password)',
    code: 0x1630,
    unit: 'none',
    effect: 'control',
    manual,
    to: 'connected',
    request,
    response: {},
  },
  lock: {
    title: 'Lock (remote password)',
    code: 0x1631,
    unit: 'none',
    effect: 'control',
    manual,
    to: 'connected',
    request,
    response: {},
  },
})
