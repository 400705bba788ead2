// What serial frames carry, in words: the SLMP commands in 3C and 4C.
import type { Explainer } from '../../codec/explanation'
import type { MelsecEndCodeFamily } from '../end-codes/family'
import {
  type ExplainSettings,
  explainRequestBody,
  explainResponseBody,
  type KnownRequest,
  readRequestBody,
} from './body'

/** What a body turned out to be. */
export interface SaidBody {
  readonly command?: string | undefined
  readonly title: string
  /** What could not be read of it must not be shown. */
  readonly secret: boolean
}

/** How the bodies of one exchange are put in words. */
export interface BodyWords {
  readonly family: MelsecEndCodeFamily
  /** The request that was given and can be read. */
  readonly asked?: { readonly name: string; readonly title: string } | undefined
  request(explainer: Explainer): SaidBody
  response(explainer: Explainer): SaidBody
}

/** Bodies of requests that the frame refers to. */
export interface KnownBodies {
  readonly request?: Buffer | undefined
  readonly registration?: Buffer | undefined
}

export type MakeWords = (settings: ExplainSettings, known: KnownBodies) => BodyWords

export const slmpWords: MakeWords = (settings, { request, registration }) => {
  const asked = readIn(request, settings)
  const registered = readIn(registration, settings)
  return {
    family: 'slmp',
    asked: asked?.command,
    request: (explainer) => said(explainRequestBody(explainer, settings)),
    response: (explainer) => said(explainResponseBody(explainer, settings, asked, registered)),
  }
}

function readIn(body: Buffer | undefined, settings: ExplainSettings): KnownRequest | undefined {
  return body && readRequestBody(body, settings)
}

function said({ command, title, secret }: ReturnType<typeof explainRequestBody>): SaidBody {
  return { command: command?.name, title, secret }
}
