// The secret function, which keeps others from the program of the PLC.
import { field } from '../../codec/codec'
import { type JwDeclaration, section } from './command'

const { text, u8 } = field

export const secretCommands = {
  /** 47 00 FB | 01: enables it. */
  setSecretFunction: {
    title: 'Set secret function',
    code: 0xfb,
    effect: 'configure',
    manual: section('FB'),
    confidence: 'derived',
    request: { function: u8({ oneOf: [0x01, 0x0f], doc: '1 enable, 0FH erase the password' }) },
    response: {},
  },

  /** 47 00 FC | 00 and four characters: releases it. */
  secretPassword: {
    title: 'Release secret/register password',
    code: 0xfc,
    effect: 'configure',
    manual: section('FC'),
    confidence: 'derived',
    request: {
      function: u8({ max: 2, doc: '0 release, 1 register for the time being, 2 register' }),
      // Which characters, only result code 32H tells.
      password: text(4, { charset: 'alphanumeric', secret: true }),
    },
    response: {},
  },

  /** 47 00 FD -> 45 00 FD 00 | 01: it is enabled. */
  readSecretState: {
    title: 'Read secret state',
    code: 0xfd,
    effect: 'read',
    manual: section('FD'),
    confidence: 'derived',
    request: {},
    response: { state: u8({ max: 1, doc: '0 disabled, 1 enabled' }) },
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
